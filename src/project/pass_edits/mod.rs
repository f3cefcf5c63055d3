//! Edits of a project's passes: other names, another order, how each is drawn and read, and taking one away.
//!
//! Owns what else of the project an edit changes, so that what is edited here is saved and opened again: a name also
//! stands in channels and groups, and the passes of a group follow each other.

mod edit;
mod groups;

pub use edit::{PassEdit, PassEditError, PassEdited};

#[cfg(test)]
mod tests;
