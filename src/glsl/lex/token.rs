//! The tokens of the lexer.

use crate::ast::ExpansionId;
use eddy_diag::Span;

/// The kind of a token. Keywords appear only after the preprocessor, which treats them as ordinary names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub(crate) enum Kind {
    Eof,
    /// End of a directive's line; the lexer returns it only inside a directive.
    Newline,
    /// Value: the symbol.
    Ident,
    /// Value: the bits. `Int` is parsed as in section 4.1.3.
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
    /// `/*` that is never closed; extends to the end of the text.
    OpenComment,
    /// A parameter in a macro's replacement list. Value: its number.
    Param,
    /// Reported already; accepted as any operand.
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
    /// A word reserved for future use. Value: the symbol.
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
    /// `precise` of GLSL 4.00, which is a name in GLSL ES 3.00: the parser tells which it is.
    Precise,
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
    /// Returns whether it is a keyword: one of the language's words, including types and reserved words.
    #[inline]
    pub(crate) fn is_keyword(self) -> bool {
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

    /// Returns whether it starts a qualifier of a declaration.
    #[inline]
    pub(crate) fn is_qualifier(self) -> bool {
        use Kind::*;
        matches!(
            self,
            Const
                | In
                | Out
                | Inout
                | Uniform
                | Flat
                | Smooth
                | Centroid
                | Invariant
                | Precise
                | Lowp
                | Mediump
                | Highp
                | Layout
        )
    }

    /// Returns whether it is an operator that has an operand on its right; `++` and `--` may follow theirs.
    #[inline]
    pub(crate) fn is_operator(self) -> bool {
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

/// White space or a comment precedes the token.
pub(crate) const SPACE: u8 = 1;
/// First token of its line.
pub(crate) const LINE_START: u8 = 2;
/// A macro's name that is never expanded, because it occurred during the expansion of that macro.
pub(crate) const PAINTED: u8 = 4;

/// A token inside the preprocessor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Token {
    pub kind: Kind,
    pub flags: u8,
    pub value: u32,
    /// The place of its characters.
    pub span: Span,
    /// The use whose replacement list it comes from.
    pub expansion: Option<ExpansionId>,
}

impl Token {
    pub(crate) fn has(&self, flag: u8) -> bool {
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
