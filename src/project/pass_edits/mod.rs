//! Edits of a project's passes: renaming, reordering, removal, and how each pass is drawn and read.
//!
//! Owns the consequences of an edit for the rest of the project, so that the result can be saved and opened again:
//! channels and groups also contain names, and the passes of a group are consecutive.

mod edit;
mod groups;

pub use edit::{PassEdit, PassEditError, PassEdited};

#[cfg(test)]
mod tests;
