//! The actions of the window: one table says their names, titles and keys, and everything that offers, explains or
//! takes an action reads it.
//!
//! Owns the table, the way from a key to an action, and the file in which a person gives actions other keys. What an
//! action does is in the shell and in the editor, each in one `match` over all of them.

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
