//! Says what the preprocessor makes of its texts.

use crate::lex::Kind;

/// A token as the parser reads it. Its place is `Origins::tokens` of the same index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tok {
    pub kind: Kind,
    /// Holds the value that [`Kind`] describes; for brackets the parser's index of the partner.
    pub value: u32,
}
