//! Words of other languages (HLSL, WGSL, C++, JavaScript, desktop GLSL).

use crate::{ast::BasicType, preprocess::Unit};

/// Returns the fix for a reserved word, if it is not just a new name.
pub(super) fn reserved(word: &str, unit: Unit) -> Option<&'static str> {
    Some(match word {
        "static" => "remove it: use `const`",
        "inline" | "noinline" => "remove it: the compiler decides",
        "public" | "extern" | "external" | "volatile" => "remove it",
        "attribute" | "varying" => match unit {
            Unit::Pass(kind) if kind.is_vertex() && word == "varying" => "GLSL ES 3.00 uses `out` instead",
            Unit::Pass(kind) if kind.is_stage() => "GLSL ES 3.00 uses `in` instead",
            _ => "GLSL ES 3.00 uses `in` and `out` instead; a pass needs neither",
        },
        "double" | "half" | "fixed" => "GLSL ES has only `float`",
        "long" | "short" => "GLSL ES has only `int` and `uint`",
        "unsigned" => "the unsigned type is `uint`",
        "goto" => "GLSL has no `goto`",
        "typedef" | "using" => "GLSL has no type aliases; use a `#define`",
        "class" => "GLSL has `struct`, without functions",
        "enum" => "write constants: `const int A = 0;`",
        "template" => "write one function for each type",
        "this" => "GLSL has no objects",
        "sizeof" => "an array knows its `length()`",
        _ => return None,
    })
}

/// Returns whether a reserved word precedes a type in other languages.
pub(super) fn is_qualifier(word: &str) -> bool {
    #[rustfmt::skip]
    let words = [
        "static", "inline", "noinline", "public", "extern", "external", "volatile", "attribute", "varying", "noperspective",
        "patch", "sample", "coherent", "restrict", "readonly", "writeonly", "superp", "subroutine",
    ];
    words.contains(&word)
}

/// Returns whether a reserved word starts a declaration of something GLSL does not have.
pub(super) fn starts_foreign_declaration(word: &str) -> bool {
    matches!(word, "class" | "enum" | "typedef" | "template" | "using" | "namespace" | "union" | "interface")
}

/// Returns the message about a type of double precision.
pub(super) fn double_precision(word: &str) -> Option<String> {
    let is_it =
        word == "double" || foreign_type(word).is_some() && (word.starts_with("dvec") || word.starts_with("dmat"));
    is_it.then(|| format!("`{word}` is not supported: Eddy computes in 32-bit floats"))
}

/// Returns the type that has this name in another language.
pub(crate) fn foreign_type(word: &str) -> Option<BasicType> {
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
        "dmat2" | "dmat2x2" => Mat2x2,
        "dmat2x3" => Mat2x3,
        "dmat2x4" => Mat2x4,
        "dmat3x2" => Mat3x2,
        "dmat3" | "dmat3x3" => Mat3x3,
        "dmat3x4" => Mat3x4,
        "dmat4x2" => Mat4x2,
        "dmat4x3" => Mat4x3,
        "dmat4" | "dmat4x4" => Mat4x4,
        _ => return None,
    })
}

/// Returns whether a word of another language starts a declaration without a type.
pub(super) fn is_typeless(word: &str) -> bool {
    matches!(word, "let" | "var" | "auto" | "val" | "def" | "fn" | "func" | "function" | "constexpr" | "local")
}
