//! Says what an editor asks about a text: what a name means, where it is declared and used, what could stand at the
//! caret, which colour a word deserves.
//!
//! Owns [`Analysis`], made of a pass by the compiler's own preprocessor, parser and checker, and the documentation of
//! what the language and the site give (`docs`). Nothing here needs a text that compiles: what the checker understood
//! answers first, and for the statement that it did not, the words as written (`text`) with the scopes around them
//! (`scope`) and the types that can be told from them (`infer`). Positions are bytes of a text, as in
//! [`eddy_diag::Span`].

mod analysis;
mod classes;
mod complete;
mod docs;
mod folds;
mod hints;
mod hover;
mod infer;
pub mod lines;
mod names;
mod occurrences;
mod outline;
mod rank;
mod rename;
mod scope;
mod show;
mod signature;
mod stops;
mod symbols;
#[cfg(test)]
mod tests;
mod text;

pub use analysis::Analysis;
pub use classes::{Class, ClassSpan};
pub use complete::{Completion, CompletionKind, Completions};
pub use folds::{Fold, FoldKind};
pub use hints::Hint;
pub use hover::Hover;
pub use outline::{OutlineKind, Outlined};
pub use rename::{Place, Places, Programs};
pub use signature::{Signature, SignatureHelp};
