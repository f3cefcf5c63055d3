//! Says what the lexer reads a text into.

use crate::ast::ExpansionId;
use eddy_diag::Span;

/// Says what a token is. Keywords appear only behind the preprocessor, to which they are names like any other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub(crate) enum Kind {
    Eof,
    /// End of a directive's line; the lexer gives it only in a directive.
    Newline,
    /// Value: the symbol.
    Ident,
    /// Value: the bits. `Int` is as section 4.1.3 reads it.
    Int,
    Uint,
    Float,
    /// Value: a [`super::number::BadNumber`].
    BadNumber,
    /// Value: the character, which GLSL does not have.
    BadChar,
    /// A name with letters that are not ASCII. Value: the symbol.
    BadName,
    /// `"text"`.
    Text,
    /// `/*` that is never closed; reaches to the end of the text.
    OpenComment,
    /// A parameter in a macro's replacement list. Value: its number.
    Param,
    /// Reported already; stands for any operand.
    Wrong,
    Hash,
    HashHash,
    LParen,
    RParen,
    LBracket,
    RBracket,
    LBrace,
    RBrace,
    Dot,
    Comma,
    Semicolon,
    Colon,
    Question,
    Plus,
    Minus,
    Star,
    Slash,
    Percent,
    PlusPlus,
    MinusMinus,
    Bang,
    Tilde,
    Less,
    Greater,
    LessEqual,
    GreaterEqual,
    EqualEqual,
    BangEqual,
    LessLess,
    GreaterGreater,
    And,
    Or,
    Caret,
    AndAnd,
    OrOr,
    CaretCaret,
    Equal,
    PlusEqual,
    MinusEqual,
    StarEqual,
    SlashEqual,
    PercentEqual,
    LessLessEqual,
    GreaterGreaterEqual,
    AndEqual,
    OrEqual,
    CaretEqual,
    /// A keyword type. Value: the symbol, see [`super::words::basic_type`].
    Type,
    /// A word kept for future use. Value: the symbol.
    Reserved,
    Const,
    In,
    Out,
    Inout,
    Uniform,
    Flat,
    Smooth,
    Centroid,
    Invariant,
    Lowp,
    Mediump,
    Highp,
    Precision,
    Layout,
    Struct,
    If,
    Else,
    For,
    While,
    Do,
    Switch,
    Case,
    Default,
    Return,
    Break,
    Continue,
    Discard,
    True,
    False,
}

impl Kind {
    /// Returns whether it is a keyword: one of the language's words, types and reserved words included.
    #[inline]
    pub fn is_keyword(self) -> bool {
        use Kind::*;
        self.is_qualifier()
            || matches!(
                self,
                Type | Reserved
                    | Precision
                    | Struct
                    | If
                    | Else
                    | For
                    | While
                    | Do
                    | Switch
                    | Case
                    | Default
                    | Return
                    | Break
                    | Continue
                    | Discard
                    | True
                    | False
            )
    }

    /// Returns whether it begins a qualifier of a declaration.
    #[inline]
    pub fn is_qualifier(self) -> bool {
        use Kind::*;
        matches!(
            self,
            Const | In | Out | Inout | Uniform | Flat | Smooth | Centroid | Invariant | Lowp | Mediump | Highp | Layout
        )
    }

    /// Returns whether it is an operator that has an operand on its right; `++` and `--` may stand behind theirs.
    #[inline]
    pub fn is_operator(self) -> bool {
        use Kind::*;
        matches!(
            self,
            Question
                | Plus
                | Minus
                | Star
                | Slash
                | Percent
                | Bang
                | Tilde
                | Less
                | Greater
                | LessEqual
                | GreaterEqual
                | EqualEqual
                | BangEqual
                | LessLess
                | GreaterGreater
                | And
                | Or
                | Caret
                | AndAnd
                | OrOr
                | CaretCaret
                | Equal
                | PlusEqual
                | MinusEqual
                | StarEqual
                | SlashEqual
                | PercentEqual
                | LessLessEqual
                | GreaterGreaterEqual
                | AndEqual
                | OrEqual
                | CaretEqual
        )
    }
}

/// White space or a comment stands before the token.
pub(crate) const SPACE: u8 = 1;
/// First token of its line.
pub(crate) const LINE_START: u8 = 2;
/// A macro's name that is to be left alone from now on, because it came up while that macro was being expanded.
pub(crate) const PAINTED: u8 = 4;

/// A token on its way through the preprocessor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Token {
    pub kind: Kind,
    pub flags: u8,
    pub value: u32,
    /// Says where its characters are.
    pub span: Span,
    /// The use whose replacement list it comes from.
    pub expansion: Option<ExpansionId>,
}

impl Token {
    pub fn has(&self, flag: u8) -> bool {
        self.flags & flag != 0
    }
}

#[inline]
pub(crate) fn is_name_start(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

#[inline]
pub(crate) fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}
