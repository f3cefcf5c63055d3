//! The window's actions: one table has their names, titles and keys, and everything that offers, explains or handles
//! an action reads it.
//!
//! Owns the table, the mapping of keys to actions, and the file in which the user assigns other keys. The shell and
//! the editor carry the actions out, each in one `match` over all of them.

mod action;
mod chord;
mod entry;
mod file;
mod key_file;
mod keymap;
mod table;

pub(super) use action::{Action, LayoutAction, PictureAction, SCALES, SIZES, TimeAction, TraceAction};
pub(super) use chord::Chord;
pub(super) use entry::{Entry, Group};
pub(super) use key_file::KeyFile;
pub(super) use keymap::{ActiveKeymap, KeyFocus, Keymap};
pub(super) use table::ACTIONS;
