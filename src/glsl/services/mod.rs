//! Editor services: the meaning of a name, its declaration and uses, completions at the caret, the colour of a word.
//!
//! Owns [`Analysis`], which the compiler's own preprocessor, parser and checker build from a pass, and the
//! documentation of predefined names (`docs`). No service requires a text that compiles: the checker's results are used
//! first, and for a statement that it did not reach, the words as written (`text`) with the scopes around them
//! (`scope`) and the types that can be inferred from them (`infer`). Positions are bytes of a text, as in
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
