//! Keywords and reserved words (section 3.8), and the interner that every compile starts from.
//!
//! Names that only desktop GLSL or later versions reserve (`buffer`, `sampler`, `texture2D`, `shared`, `precise`) are
//! plain names here, as they are in GLSL ES 3.00.

use super::token::Kind;
use crate::{
    ast::{BasicType, Interner, Symbol},
    hir::{Builtin, Uniform},
};
use std::sync::LazyLock;

const FIRST_TYPE: u32 = (Builtin::COUNT + Uniform::ALL.len()) as u32;
const FIRST_KEYWORD: u32 = FIRST_TYPE + BasicType::ALL.len() as u32 + TYPE_ALIASES.len() as u32;
const FIRST_RESERVED: u32 = FIRST_KEYWORD + KEYWORDS.len() as u32;
const END: u32 = FIRST_RESERVED + RESERVED.len() as u32;

/// Alternative spellings of square matrices.
const TYPE_ALIASES: [(&str, BasicType); 3] =
    [("mat2x2", BasicType::Mat2x2), ("mat3x3", BasicType::Mat3x3), ("mat4x4", BasicType::Mat4x4)];

const KEYWORDS: [(&str, Kind); 29] = [
    ("const", Kind::Const),
    ("in", Kind::In),
    ("out", Kind::Out),
    ("inout", Kind::Inout),
    ("uniform", Kind::Uniform),
    ("flat", Kind::Flat),
    ("smooth", Kind::Smooth),
    ("centroid", Kind::Centroid),
    ("invariant", Kind::Invariant),
    ("lowp", Kind::Lowp),
    ("mediump", Kind::Mediump),
    ("highp", Kind::Highp),
    ("precision", Kind::Precision),
    ("layout", Kind::Layout),
    ("struct", Kind::Struct),
    ("if", Kind::If),
    ("else", Kind::Else),
    ("for", Kind::For),
    ("while", Kind::While),
    ("do", Kind::Do),
    ("switch", Kind::Switch),
    ("case", Kind::Case),
    ("default", Kind::Default),
    ("return", Kind::Return),
    ("break", Kind::Break),
    ("continue", Kind::Continue),
    ("discard", Kind::Discard),
    ("true", Kind::True),
    ("false", Kind::False),
];

/// Words that browsers reject as names, by ANGLE's lexer (`glslang.l`, words reserved for GLSL ES 3.00). Some drivers
/// accept a few of them (Mesa: `image1DShadow`), but no program on Shadertoy can use them.
#[rustfmt::skip]
const RESERVED: &[&str] = &[
    "attribute", "varying", "coherent", "volatile", "restrict", "readonly", "writeonly", "resource", "atomic_uint",
    "noperspective", "patch", "sample", "subroutine", "common", "partition", "active", "asm", "class", "union", "enum",
    "typedef", "template", "this", "goto", "inline", "noinline", "public", "static", "extern", "external", "interface",
    "long", "short", "double", "half", "fixed", "unsigned", "superp", "input", "output", "hvec2", "hvec3", "hvec4",
    "dvec2", "dvec3", "dvec4", "fvec2", "fvec3", "fvec4", "sampler3DRect", "filter", "image1D", "image2D", "image3D",
    "imageCube", "iimage1D", "iimage2D", "iimage3D", "iimageCube", "uimage1D", "uimage2D", "uimage3D", "uimageCube",
    "image1DArray", "image2DArray", "iimage1DArray", "iimage2DArray", "uimage1DArray", "uimage2DArray", "imageBuffer",
    "iimageBuffer", "uimageBuffer", "sampler1DShadow", "sampler1DArray", "sampler1DArrayShadow",
    "isampler1D", "isampler1DArray", "usampler1D", "usampler1DArray", "sampler2DRect", "sampler2DRectShadow",
    "isampler2DRect", "usampler2DRect", "samplerBuffer", "isamplerBuffer", "usamplerBuffer", "sampler2DMS",
    "isampler2DMS", "usampler2DMS", "sampler2DMSArray", "isampler2DMSArray", "usampler2DMSArray", "image1DShadow",
    "image2DShadow", "image1DArrayShadow", "image2DArrayShadow", "sizeof", "cast", "namespace", "using",
];

/// Words of [`RESERVED`] that GLSL 1.20 and GLSL ES 1.00 (section 3.6 of both) reserve, too: no version accepts them as
/// names.
#[rustfmt::skip]
const RESERVED_IN_ALL: &[&str] = &[
    "asm", "class", "union", "enum", "typedef", "template", "this", "goto", "inline", "noinline", "volatile", "public",
    "static", "extern", "external", "interface", "long", "short", "double", "half", "fixed", "unsigned", "input",
    "output", "hvec2", "hvec3", "hvec4", "dvec2", "dvec3", "dvec4", "fvec2", "fvec3", "fvec4", "sampler2DRect",
    "sampler3DRect", "sampler2DRectShadow", "sizeof", "cast", "namespace", "using",
];

/// Returns whether the word belongs to the language, as a keyword, a type or otherwise.
pub(crate) fn is_word(name: &str) -> bool {
    seeded().find(name).is_some()
}

/// Returns every keyword that is not a type.
pub(crate) fn keywords() -> impl Iterator<Item = &'static str> {
    KEYWORDS.iter().map(|k| k.0)
}

/// The role of a word in the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    Builtin,
    Uniform,
    Type,
    /// A keyword that is not a type, or a reserved word.
    Keyword,
}

/// Returns the meaning of a word of the language; `None` for an author's name.
pub(crate) fn meaning(name: &str) -> Option<Meaning> {
    let symbol = seeded().find(name)?.0;
    Some(match symbol {
        // Only in some texts: in the others it is an author's name.
        _ if Builtin::from_symbol(Symbol(symbol)).is_some_and(|builtin| builtin.since > 0) => return None,
        _ if symbol < Builtin::COUNT as u32 => Meaning::Builtin,
        _ if symbol < FIRST_TYPE => Meaning::Uniform,
        SAMPLER_1D => Meaning::Keyword,
        _ if symbol < FIRST_KEYWORD => Meaning::Type,
        _ => Meaning::Keyword,
    })
}

/// Returns an interner that contains all words of the language.
pub(crate) fn interner() -> Interner {
    seeded().clone()
}

fn seeded() -> &'static Interner {
    static SEEDED: LazyLock<Interner> = LazyLock::new(|| {
        Interner::seeded(
            Builtin::all()
                .map(|builtin| builtin.row().name)
                .chain(Uniform::ALL.iter().map(|u| u.name()))
                .chain(BasicType::ALL.iter().map(|t| t.name()))
                .chain(TYPE_ALIASES.iter().map(|a| a.0))
                .chain(KEYWORDS.iter().map(|k| k.0))
                .chain(RESERVED.iter().copied()),
        )
    });
    &SEEDED
}

/// The symbol of `sampler1D`, which GLSL ES reserves.
const SAMPLER_1D: u32 = FIRST_TYPE + BasicType::Sampler1D as u32;

/// Returns `Ident`, or the keyword that a name is.
#[inline]
pub(crate) fn kind(symbol: u32) -> Kind {
    // A single comparison for the author's names, which come after the seed.
    if !(FIRST_TYPE..END).contains(&symbol) {
        Kind::Ident
    } else if symbol == SAMPLER_1D {
        Kind::Reserved
    } else if symbol < FIRST_KEYWORD {
        Kind::Type
    } else if symbol < FIRST_RESERVED {
        KEYWORDS[(symbol - FIRST_KEYWORD) as usize].1
    } else {
        Kind::Reserved
    }
}

/// Does the same for texts of any version of GLSL: words that some version accepts as names are names, and `attribute`
/// and `varying` are the earlier names of `in` (GLSL 1.30, section 1.5.1).
pub(crate) fn kind_in_any_version(symbol: u32) -> Kind {
    match kind(symbol) {
        Kind::Reserved if symbol == SAMPLER_1D => Kind::Type,
        Kind::Reserved => match RESERVED[(symbol - FIRST_RESERVED) as usize] {
            "attribute" | "varying" => Kind::In,
            word if RESERVED_IN_ALL.contains(&word) => Kind::Reserved,
            _ => Kind::Ident,
        },
        kind => kind,
    }
}

/// Returns whether a word of the language is a name in texts of any version of GLSL.
pub(crate) fn is_name_in_some_version(name: &str) -> bool {
    seeded().find(name).is_some_and(|symbol| kind_in_any_version(symbol.0) == Kind::Ident)
}

/// Returns the type of a `Kind::Type` token's symbol.
pub(crate) fn basic_type(symbol: u32) -> BasicType {
    let i = (symbol - FIRST_TYPE) as usize;
    BasicType::ALL.get(i).copied().unwrap_or_else(|| TYPE_ALIASES[i - BasicType::ALL.len()].1)
}
