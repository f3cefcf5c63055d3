//! Uniforms that texts declare in plain GLSL, found by a scan for words: the compiler knows better, but runs later.

use crate::{CustomUniformValue, CustomUniformValues};
use std::{collections::BTreeSet, ops::Range};

/// Every word of the declarations `uniform .. name ..;` of a text, including the names of uniforms.
pub(crate) fn words_of_uniforms(text: &str) -> BTreeSet<String> {
    let text = blanked(text);
    declarations(&text)
        .into_iter()
        .flat_map(|range| words(&text[range]).map(str::to_owned).collect::<Vec<_>>())
        .collect()
}

/// A text with a constant in place of each uniform that has a value, for Shadertoy, which does not set them.
/// Declarations of several names, or of another shape than the value's, are unchanged.
pub(super) fn as_constants(text: &str, values: &CustomUniformValues) -> String {
    let blank = blanked(text);
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    for range in declarations(&blank) {
        let Some(value) = constant(&blank[range.clone()], values) else { continue };
        out.push_str(&text[done..range.start]);
        out.push_str(&format!("const{} = {value}", &text[range.start + "uniform".len()..range.end]));
        done = range.end;
    }
    out + &text[done..]
}

/// The value for `uniform vec3 kernel[64]`.
fn constant(declaration: &str, values: &CustomUniformValues) -> Option<String> {
    if declaration.contains(',') {
        return None;
    }
    let mut words = words(declaration).skip(1).filter(|w| !["highp", "mediump", "lowp"].contains(w));
    let ty = words.next()?;
    let is_array = declaration.contains('[');
    // An array length may come between type and name, or after the name.
    let value = words.find_map(|word| values.get(word))?;
    if !is_array {
        return of_type(ty, value);
    }
    let all: Option<Vec<String>> = match value {
        CustomUniformValue::Vector(all) => all.iter().map(|x| of_type(ty, &CustomUniformValue::Float(*x))).collect(),
        CustomUniformValue::List(all) => all.iter().map(|one| of_type(ty, one)).collect(),
        _ => None,
    };
    Some(format!("{ty}[]({})", all?.join(", ")))
}

fn of_type(ty: &str, value: &CustomUniformValue) -> Option<String> {
    let is_one =
        |value: &CustomUniformValue| !matches!(value, CustomUniformValue::Vector(_) | CustomUniformValue::List(_));
    let float = |x: f64| format!("{:?}", x as f32);
    let first = value.components().first().copied();
    Some(match (ty, is_one(value)) {
        ("bool", true) => (first? != 0.0).to_string(),
        ("int", true) => format!("{}", first?),
        ("uint", true) => format!("{}u", first?),
        ("float", true) => float(first?),
        ("bool" | "int" | "uint" | "float", false) | (_, true) => return None,
        (_, false) => format!("{ty}({})", value.components().into_iter().map(float).collect::<Vec<_>>().join(", ")),
    })
}

/// Returns the ranges from each word `uniform` to before the end of its declaration, except blocks.
fn declarations(blank: &str) -> Vec<Range<usize>> {
    let mut all = Vec::new();
    let mut at = 0;
    while let Some(start) = blank[at..].find("uniform").map(|n| at + n) {
        at = start + "uniform".len();
        let is_word = !blank[..start].ends_with(is_of_word) && !blank[at..].starts_with(is_of_word);
        if !is_word {
            continue;
        }
        // If this declaration has no end, no later one has.
        let Some(end) = blank[at..].find([';', '{', '}']).map(|n| at + n) else { break };
        if blank[end..].starts_with(';') {
            all.push(start..end);
        }
        at = end;
    }
    all
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c| !is_of_word(c)).filter(|w| !w.is_empty())
}

/// Replaces comments by blanks, byte for byte.
fn blanked(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    // Each byte is visited once, whichever kind of comment the text has.
    let slashes = memchr::memchr_iter(b'/', text.as_bytes());
    for at in slashes {
        if at < done {
            continue;
        }
        let end = match text.as_bytes().get(at + 1) {
            Some(b'*') => text[at + 2..].find("*/").map(|n| at + 4 + n),
            Some(b'/') => memchr::memchr(b'\n', &text.as_bytes()[at..]).map(|n| at + n),
            _ => continue,
        };
        let end = end.unwrap_or(text.len());
        out.push_str(&text[done..at]);
        out.extend(std::iter::repeat_n(' ', end - at));
        done = end;
    }
    out + &text[done..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_distinguished_from_other_mentions() {
        for text in [
            "uniform vec3 kernel[64];",
            "uniform highp float a, kernel;",
            "float x; uniform\tmat4\n/* of the */ kernel // one\n[2];",
        ] {
            assert!(words_of_uniforms(text).contains("kernel"), "{text}");
        }
        for text in [
            "// uniform vec3 kernel[64];",
            "/* uniform */ vec3 kernel;",
            "uniform float a; float kernel;",
            "uniform float kernels;",
            "uniform Block { float kernel; };",
            "nonuniform float kernel;",
            "/* uniform float kernel;",
            "",
        ] {
            assert!(!words_of_uniforms(text).contains("kernel"), "{text}");
        }
    }

    #[test]
    fn a_uniform_with_a_value_becomes_a_constant() {
        let list = |all: &[&[f64]]| {
            CustomUniformValue::List(all.iter().map(|v| CustomUniformValue::Vector(v.to_vec())).collect())
        };
        let values = CustomUniformValues::from([
            ("kernel".to_owned(), list(&[&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.5]])),
            ("m".to_owned(), list(&[&[1.0, 2.0], &[3.0, 4.0]])),
            ("w".to_owned(), CustomUniformValue::Vector(vec![1.0, 2.0, 3.0])),
            ("n".to_owned(), CustomUniformValue::Int(-3)),
            ("u".to_owned(), CustomUniformValue::Int(3)),
            ("on".to_owned(), CustomUniformValue::Bool(true)),
        ]);
        for (text, expected) in [
            (
                "a; uniform vec3 kernel[2]; // é\nb",
                "a; const vec3 kernel[2] = vec3[](vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.5)); // é\nb",
            ),
            ("/* é */ uniform highp mat2 m;", "/* é */ const highp mat2 m = mat2(1.0, 2.0, 3.0, 4.0);"),
            ("uniform float[N] w;", "const float[N] w = float[](1.0, 2.0, 3.0);"),
            ("uniform int n; uniform uint u;", "const int n = -3; const uint u = 3u;"),
            ("uniform bool on;", "const bool on = true;"),
            ("uniform float n, u;", "uniform float n, u;"),
            ("uniform float other;", "uniform float other;"),
            ("uniform vec2 n;", "uniform vec2 n;"),
        ] {
            assert_eq!(as_constants(text, &values), expected);
        }
    }
}
