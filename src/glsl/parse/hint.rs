//! What authors most likely meant: slips, and words of other languages (HLSL, WGSL, C++, JavaScript, desktop GLSL).

use super::*;
use crate::glsl::ast::BasicType;

/// A keyword or reserved word.
pub(super) fn is_keyword(kind: Kind) -> bool {
    kind as u8 >= Kind::Type as u8
}

/// The mend for a reserved word, where another than a new name.
pub(super) fn reserved(word: &str) -> Option<&'static str> {
    Some(match word {
        "static" => "leave it out: a `const` is as good",
        "inline" | "noinline" => "leave it out: the compiler decides",
        "public" | "extern" | "external" | "volatile" => "leave it out",
        "attribute" | "varying" => "GLSL ES 3.00 has `in` and `out` instead; a pass needs neither",
        "double" | "half" | "fixed" => "GLSL ES has only `float`",
        "long" | "short" => "GLSL ES has only `int` and `uint`",
        "unsigned" => "the unsigned type is `uint`",
        "goto" => "GLSL has no `goto`",
        "typedef" | "using" => "GLSL has no names for types but `struct`; a `#define` may do",
        "class" => "GLSL has `struct`, without functions",
        "enum" => "write constants: `const int A = 0;`",
        "template" => "write one function for each type",
        "this" => "GLSL has no objects",
        "sizeof" => "an array knows its `length()`",
        _ => return None,
    })
}

/// Reserved words that stand before a type in other languages.
pub(super) fn is_qualifier(word: &str) -> bool {
    #[rustfmt::skip]
    let words = [
        "static", "inline", "noinline", "public", "extern", "external", "volatile", "attribute", "varying", "noperspective",
        "patch", "sample", "coherent", "restrict", "readonly", "writeonly", "superp", "subroutine",
    ];
    words.contains(&word)
}

/// Reserved words that begin a declaration of something GLSL does not have.
pub(super) fn begins_foreign_declaration(word: &str) -> bool {
    matches!(word, "class" | "enum" | "typedef" | "template" | "using" | "namespace" | "union" | "interface")
}

/// The type that another language calls so.
pub(in crate::glsl) fn foreign_type(word: &str) -> Option<BasicType> {
    use BasicType::*;
    Some(match word {
        "double" | "half" | "fixed" | "f32" | "float1" | "real" => Float,
        "float2" | "half2" | "fixed2" | "vec2f" | "Vec2" | "hvec2" | "dvec2" | "fvec2" | "Vector2" => Vec2,
        "float3" | "half3" | "fixed3" | "vec3f" | "Vec3" | "hvec3" | "dvec3" | "fvec3" | "Vector3" => Vec3,
        "float4" | "half4" | "fixed4" | "vec4f" | "Vec4" | "hvec4" | "dvec4" | "fvec4" | "Vector4" => Vec4,
        "i32" | "long" | "short" | "integer" | "int32_t" => Int,
        "int2" | "vec2i" => Ivec2,
        "int3" | "vec3i" => Ivec3,
        "int4" | "vec4i" => Ivec4,
        "u32" | "unsigned" | "uint32_t" => Uint,
        "uint2" | "vec2u" => Uvec2,
        "uint3" | "vec3u" => Uvec3,
        "uint4" | "vec4u" => Uvec4,
        "boolean" => Bool,
        "bool2" => Bvec2,
        "bool3" => Bvec3,
        "bool4" => Bvec4,
        "float2x2" | "half2x2" | "mat2x2f" => Mat2x2,
        "float3x3" | "half3x3" | "mat3x3f" => Mat3x3,
        "float4x4" | "half4x4" | "mat4x4f" => Mat4x4,
        _ => return None,
    })
}

/// Words of other languages before a name that is declared without its type.
pub(super) fn is_typeless(word: &str) -> bool {
    matches!(word, "let" | "var" | "auto" | "val" | "def" | "fn" | "func" | "function" | "constexpr" | "local")
}

impl Parser<'_> {
    /// The next token does not fit; `expected` would.
    #[cold]
    pub(super) fn unexpected(&mut self, expected: &str) -> Failed {
        let i = self.at;
        if matches!(self.kind(), Kind::RParen | Kind::RBracket) && self.partner(i).is_none() {
            let message = format!("{} closes nothing", self.shown(i));
            return self.fail(i, message, None);
        }
        let word = self.text(i);
        let hint = match self.kind() {
            Kind::Ident => match word {
                "and" => Some("write `&&`".to_owned()),
                "or" => Some("write `||`".into()),
                "xor" => Some("write `^^`".into()),
                _ => None,
            },
            Kind::Colon => Some("`:` belongs to `?` and to the labels of `switch`".into()),
            _ => None,
        };
        let operand = matches!(
            self.kind(),
            Kind::Ident | Kind::Type | Kind::Int | Kind::Uint | Kind::Float | Kind::Reserved | Kind::True | Kind::False
        );
        let message = if operand && !self.starts_line(i) && i > 0 && expected == "`;`" {
            format!("missing an operator or `;` between {} and {}", self.shown(i - 1), self.shown(i))
        } else {
            format!("expected {expected}, found {}", self.shown(i))
        };
        self.fail(i, message, hint)
    }

    /// The next token cannot begin an operand.
    #[cold]
    pub(super) fn no_operand(&mut self) -> Failed {
        let i = self.at;
        let kind = self.kind();
        let before = if i > 0 { self.kind_at(i - 1) } else { Kind::Eof };
        let touches = i > 0 && self.adjacent(i - 1);
        let slip = match (before, kind) {
            _ if !touches => None,
            (Kind::Star, Kind::Star) => Some(("GLSL has no operator `**`", "write `pow(a, b)`")),
            (Kind::Minus, Kind::Greater) => Some(("GLSL has no `->`", "write `.`")),
            (Kind::EqualEqual, Kind::Equal) => Some(("GLSL has no `===`", "write `==`")),
            (Kind::BangEqual, Kind::Equal) => Some(("GLSL has no `!==`", "write `!=`")),
            (Kind::Equal, Kind::Less) => Some(("GLSL has no `=<`", "write `<=`")),
            (Kind::Equal, Kind::Greater) => Some(("GLSL has no `=>`", "write `>=`")),
            (Kind::Less, Kind::Greater) => Some(("GLSL has no `<>`", "write `!=`")),
            (Kind::GreaterGreater, Kind::Greater) => Some(("GLSL has no `>>>`", "shift a `uint` with `>>`")),
            (Kind::Colon, Kind::Colon) => Some(("GLSL has no `::`", "names are not grouped; write the name alone")),
            _ => None,
        };
        if let Some((message, hint)) = slip {
            return self.fail(i, message, Some(hint.into()));
        }
        if matches!(kind, Kind::Star | Kind::And) && !matches!(before, Kind::Semicolon | Kind::LBrace | Kind::RBrace) {
            let hint = "a parameter that the function may change is `inout`";
            return self.fail(i, "GLSL has no pointers and references", Some(hint.into()));
        }
        match before {
            Kind::LParen | Kind::Comma if matches!(kind, Kind::Comma | Kind::RParen) => {
                let message = format!("a value is missing between {} and {}", self.shown(i - 1), self.shown(i));
                self.fail(i, message, None)
            }
            before if is_operator(before) => {
                let message = format!("{} needs a value on its right, found {}", self.shown(i - 1), self.shown(i));
                let hint = self.statement_hint(i);
                self.fail(i, message, hint)
            }
            _ if matches!(kind, Kind::RParen | Kind::RBracket) && self.partner(i).is_none() => {
                let message = format!("{} closes nothing", self.shown(i));
                self.fail(i, message, None)
            }
            _ => {
                let message = format!("expected an expression, found {}", self.shown(i));
                let hint = self.statement_hint(i);
                self.fail(i, message, hint)
            }
        }
    }

    fn statement_hint(&self, i: usize) -> Option<String> {
        matches!(self.kind_at(i), Kind::If | Kind::Switch)
            .then(|| format!("{} gives no value: write `condition ? a : b`", self.shown(i)))
    }

    /// A type where a value must stand.
    #[cold]
    pub(super) fn type_as_operand(&mut self, first: usize) -> Failed {
        let name = self.text(first).to_owned();
        let before = if first > 0 { self.kind_at(first - 1) } else { Kind::Eof };
        if is_operator(before) && self.starts_line(first) {
            let message = format!("{} needs a value on its right", self.shown(first - 1));
            return self.fail(first - 1, message, None);
        }
        let hint = if self.kind() == Kind::Ident && matches!(before, Kind::LParen | Kind::Comma) {
            format!("a call takes values only: leave out `{name}`")
        } else {
            format!("`{name}(..)` makes one")
        };
        self.fail(first, format!("`{name}` is a type, not a value"), Some(hint))
    }
}

fn is_operator(kind: Kind) -> bool {
    (Kind::Question as u8..=Kind::CaretEqual as u8).contains(&(kind as u8))
        && !matches!(kind, Kind::PlusPlus | Kind::MinusMinus)
}
