//! Eddy's editor services over the Language Server Protocol (version 3.17), for any editor that speaks it.
//!
//! Owns the documents that an editor has open, the projects that they belong to, and the conversion of the answers of
//! [`eddy_glsl::services`]. [`Server`] takes messages and returns messages, without a stream: [`serve`] connects one to
//! standard input and output. The diagnostics of a project are those of `eddy check`, with the editor's unsaved texts
//! in place of the files on disk.
//!
//! Formatting is not offered: the author decides the layout of a shader.

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
