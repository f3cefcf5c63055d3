//! Directives that GLSL ES does not have: `#include` lines without a file name, and those of other tools.
//!
//! A text with one of them is incomplete. Any further errors would be consequences, so reading stops there.

use super::{directive::DIRECTIVES, state::Preprocessor};
use crate::{lex::Token, near::nearest_identifier};

/// Eddy's own directives. They are in the texts that Eddy reads; those of the correct form are removed before the
/// compiler.
pub(super) const OWN: [&str; 6] = ["include", "iUniform", "iChannel0", "iChannel1", "iChannel2", "iChannel3"];

const CHANNEL_FORM: &str = "write #iChannel0 \"buffer_a\", or #iChannel0::WrapMode \"Repeat\"";

impl Preprocessor<'_, '_> {
    /// Reports an `#include` line that does not name a file in the correct form.
    pub(super) fn include(&mut self, name: &Token, line: &[Token]) {
        let rest = self.rest_of(line);
        let (message, hint) = include_mistake(&rest);
        self.stop(name, message, Some(hint));
    }

    /// Processes or rejects a directive that GLSL does not have.
    pub(super) fn unknown_directive(&mut self, name: &Token, other: &str, line: &[Token]) {
        let rest = self.rest_of(line);
        let stop = match other {
            // It requests that only `mainImage` be the entry point, which is always the case.
            "StrictCompatibility" => return,
            "iKeyboard" => Some((
                "Eddy has no `#iKeyboard`, a directive of the VS Code extension \"Shader Toy\"".to_owned(),
                "read the keyboard from a channel, as on Shadertoy: #iChannel0 \"keyboard\", and \
                 texelFetch(iChannel0, ivec2(65, 0), 0).x is 1 while A is down"
                    .to_owned(),
            )),
            "iVertex" => Some((
                "Eddy has no `#iVertex`, a directive of the VS Code extension \"Shader Toy\"".to_owned(),
                "to draw meshes with a vertex stage, set `draws` of a pass in eddy.toml".to_owned(),
            )),
            "iFirstPersonControls" => Some((
                "Eddy has no `#iFirstPersonControls`, a directive of the VS Code extension \"Shader Toy\"".to_owned(),
                "control the camera with iMouse or an #iUniform".to_owned(),
            )),
            "import" | "include_next" | "inject" | "use" | "require" | "pragma_include" => {
                let path = quoted(&rest).filter(|path| !path.is_empty()).unwrap_or("noise.glsl");
                Some((format!("there is no directive `#{other}`"), format!("write #include \"{path}\"")))
            }
            _ if other.eq_ignore_ascii_case("include") => {
                let path = quoted(&rest).filter(|path| !path.is_empty()).unwrap_or("noise.glsl");
                let message = format!("there is no directive `#{other}`: upper and lower case differ");
                Some((message, format!("write #include \"{path}\"")))
            }
            _ => None,
        };
        if let Some((message, hint)) = stop {
            self.stop(name, message, Some(hint));
            return;
        }
        let message = format!("there is no directive `#{other}`");
        let hint = match other {
            "elseif" | "elsif" | "elsei" => Some("did you mean `#elif`?".to_owned()),
            _ if other.to_ascii_lowercase().starts_with("ichannel") => Some(CHANNEL_FORM.to_owned()),
            _ => {
                let near = nearest_identifier(other, DIRECTIVES.into_iter().chain(OWN));
                near.map(|near| format!("did you mean `#{near}`?"))
            }
        };
        let meant = hint.as_deref().and_then(|hint| hint.strip_prefix("did you mean `#")?.strip_suffix("`?"));
        let meant = meant.map(str::to_owned);
        self.error_with(name, message, hint, meant.as_deref());
    }

    /// Rejects a pragma that includes, and warns of one that a tool should have replaced by a text. All others are
    /// ignored, as specified (section 3.5).
    pub(super) fn foreign_pragma(&mut self, line: &[Token]) {
        let Some(first) = line.first() else { return };
        let rest = self.rest_of(line);
        match self.text(first.span) {
            "include" => {
                let path = quoted(&rest).filter(|path| !path.is_empty()).unwrap_or("noise.glsl").to_owned();
                self.stop(
                    first,
                    "`#pragma include` includes nothing".into(),
                    Some(format!("write #include \"{path}\"")),
                );
            }
            "glslify" if rest.contains("require") => self.warning(
                first,
                "this line does nothing: Eddy does not support glslify modules",
                Some(
                    "run glslify first, or save the module next to this file and write #include \"noise.glsl\"".into(),
                ),
            ),
            _ => {}
        }
    }

    /// Returns the words of a directive as written.
    fn rest_of(&self, line: &[Token]) -> String {
        match (line.first(), line.last()) {
            (Some(first), Some(last)) => self.text(first.span.to(last.span)).to_owned(),
            _ => String::new(),
        }
    }
}

/// Returns the text between the quotes or angle brackets of a line.
fn quoted(rest: &str) -> Option<&str> {
    let start = rest.find(['"', '\'', '<'])?;
    let close = if rest[start..].starts_with('<') { '>' } else { rest[start..].chars().next()? };
    let inner = &rest[start + 1..];
    Some(inner.split_once(close).map_or(inner, |(inner, _)| inner).trim())
}

/// Returns the error of an `#include` line, and the fix.
fn include_mistake(rest: &str) -> (String, String) {
    let form = || "write #include \"noise.glsl\"".to_owned();
    let write = |path: &str| format!("write #include \"{path}\"");
    let path = quoted(rest);
    match rest.chars().next() {
        None => ("this #include has no file name".into(), form()),
        Some('"' | '\'' | '<') if path.is_some_and(str::is_empty) => ("this #include has no file name".into(), form()),
        Some('<') => {
            let path = path.unwrap_or_default();
            if is_chunk(path) {
                let message = format!("`{path}` is a chunk of three.js, which Eddy does not include");
                (message, format!("save the chunk in a file next to this one: #include \"{path}.glsl\""))
            } else if path == "metal_stdlib" {
                ("this code is Metal, not GLSL".into(), "write the shader in GLSL ES 3.00".into())
            } else {
                ("write the #include file in double quotes, not in angle brackets".into(), write(path))
            }
        }
        Some('\'') => {
            let message = "write the #include file in double quotes, not in single quotes".into();
            (message, write(path.unwrap_or_default()))
        }
        Some('"') => {
            let inner = &rest[1..];
            match inner.split_once('"') {
                None => ("the closing quote after the file name is missing".into(), write(inner.trim())),
                Some((path, more)) => {
                    let message = format!("unexpected `{}` after the #include file", more.trim());
                    (message, write(path))
                }
            }
        }
        Some(_) => {
            let path = rest.split_whitespace().next().unwrap_or_default();
            let path = path.trim_end_matches([';', ',', '"', '\'', '>']);
            match rest.split_once(['"', '<']) {
                // `#include "a.glsl"` with other text before it.
                Some(_) => ("an #include takes one file in double quotes".into(), form()),
                None => ("write the #include file in double quotes".into(), write(path)),
            }
        }
    }
}

/// Returns whether a name in angle brackets is one of three.js's chunks, whose names have no file extension.
fn is_chunk(name: &str) -> bool {
    let known = ["common", "packing", "clipping_planes_pars", "cube_uv_reflection_fragment", "bsdfs", "defaultnormal"];
    let ends = ["_fragment", "_vertex", "_pars", "_begin", "_maps", "_end", "_physical"];
    known.contains(&name)
        || name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && ends.iter().any(|e| name.ends_with(e))
}

#[cfg(test)]
mod tests {
    use super::include_mistake;

    #[test]
    fn each_form_has_a_fix() {
        for (rest, message, hint) in [
            ("", "has no file name", "write #include \"noise.glsl\""),
            ("\"\"", "has no file name", "write #include \"noise.glsl\""),
            ("< >", "has no file name", "write #include \"noise.glsl\""),
            ("<lib.glsl>", "not in angle brackets", "write #include \"lib.glsl\""),
            ("<lib/a b.glsl", "not in angle brackets", "write #include \"lib/a b.glsl\""),
            ("<common>", "chunk of three.js", "#include \"common.glsl\""),
            ("<fog_pars_fragment>", "chunk of three.js", "save the chunk"),
            ("<metal_stdlib>", "Metal", "GLSL ES 3.00"),
            ("'lib.glsl'", "not in single quotes", "write #include \"lib.glsl\""),
            ("\"lib.glsl", "closing quote", "write #include \"lib.glsl\""),
            ("\"lib.glsl\" ; x", "unexpected `; x`", "write #include \"lib.glsl\""),
            ("lib.glsl", "in double quotes", "write #include \"lib.glsl\""),
            ("lib/noise.glsl;", "in double quotes", "write #include \"lib/noise.glsl\""),
            ("FILE \"a\"", "one file in double quotes", "write #include \"noise.glsl\""),
        ] {
            let (said, fix) = include_mistake(rest);
            assert!(said.contains(message) && fix.contains(hint), "{rest}: {said}; {fix}");
        }
    }
}
