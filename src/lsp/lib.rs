//! Eddy's editor services over the Language Server Protocol (version 3.17), for any editor that speaks it.
//!
//! Owns the documents that an editor has open, the projects that they belong to, and the translation of what
//! [`eddy_glsl::services`] answers. [`Server`] takes messages and returns messages, and knows no stream: [`serve`] connects
//! one to standard input and output. What is wrong with a project is what `eddy check` says of it, with the editor's
//! unsaved texts in place of what is on disk.
//!
//! Formatting is not offered: the layout of a shader is its author's.

mod actions;
mod completion;
mod documents;
mod hints;
mod hover;
mod messages;
mod navigation;
mod positions;
mod program;
mod published;
mod reading;
mod requests;
mod server;
mod symbols;
mod tokens;
mod transport;
mod uris;
mod workspace;

pub use server::Server;
pub use transport::serve;
