//! The code editor: a widget for GLSL that lays out only the visible pieces of lines.
//!
//! Owns the text while it is being edited (with its undo), its colours, the caret, the marks next to lines and the
//! help while writing. Knows nothing of projects or of compiling: it gets marks and an analysis of its text, and
//! reports changes of the text and requests to go elsewhere. egui's own `TextEdit` lays the whole text out on every
//! change, 11 ms a keystroke at 2,000 lines. Here the cost of a keystroke grows neither with the text nor with the
//! line: it took 0.3 ms in 142 lines, 0.5 ms in 17,000 and 1.4 ms in a single line of 10 MB (`cost`, two slow cores
//! under load, not optimised).

mod accessible;
mod action;
mod assist;
mod block_comments;
mod brackets;
mod buffer;
mod colors;
#[cfg(test)]
mod cost;
mod edits;
mod find;
mod folding;
mod gutter;
mod highlight;
mod history;
mod input;
mod line_cost;
mod line_edits;
mod lines;
mod look;
mod many;
mod motion;
mod nesting;
mod paint;
mod pairs;
mod pieces;
mod pointer;
mod rows;
mod ruler;
mod selection;
mod semantic;
mod view;
mod wrap;

pub(super) use action::EditorAction;
pub(super) use assist::EditorRequest;
pub(super) use buffer::Buffer;
pub(super) use find::{Finder, Query};
pub(super) use line_cost::LineCost;
pub(super) use look::{Debug, Help, Look, Mark};
pub(super) use motion::{Motion, Vertical};
pub(super) use view::CodeEditor;

#[cfg(test)]
mod tests;
