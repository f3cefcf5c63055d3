//! Custom uniforms as constants, for Shadertoy, which cannot set them.

use super::CustomUniform;
use crate::{CustomUniformValues, lines::hash_lines};
use std::fmt::Write;

/// A text with plain GLSL constants at its top in place of the custom uniforms it declares. The declaring lines stay as
/// comments. Uniforms declared in plain GLSL become constants in place, if they have a value.
pub(crate) fn text<'k>(
    text: &str,
    custom_uniforms: impl Iterator<Item = &'k CustomUniform>,
    values: &CustomUniformValues,
) -> String {
    let mark = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut out = text[..mark].to_owned();
    for custom_uniform in custom_uniforms {
        let _ = writeln!(
            out,
            "const {} {} = {};",
            custom_uniform.ty.glsl_name(),
            custom_uniform.name,
            custom_uniform.value(values).glsl(custom_uniform.ty)
        );
    }
    let mut done = mark;
    for line in hash_lines(text).into_iter().filter(super::is_declaration) {
        let start = line.range.start.max(mark);
        out.push_str(&text[done..start]);
        out.push_str("// ");
        done = start;
    }
    out.push_str(&text[done..]);
    super::declared::as_constants(&out, values)
}
