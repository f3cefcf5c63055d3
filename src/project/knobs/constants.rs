//! Knobs as constants, for where nobody can turn them: the site.

use super::Knob;
use crate::project::{KnobValues, lines::hash_lines};
use std::fmt::Write;

/// A text with plain GLSL constants at its top in place of the knobs it declares. The declaring lines stay as comments.
/// Uniforms in GLSL's own way become constants where they stand, if they have a value.
pub(in crate::project) fn text<'k>(text: &str, knobs: impl Iterator<Item = &'k Knob>, values: &KnobValues) -> String {
    let mark = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut out = text[..mark].to_owned();
    for knob in knobs {
        let _ = writeln!(out, "const {} {} = {};", knob.ty.glsl_name(), knob.name, knob.value(values).glsl(knob.ty));
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
