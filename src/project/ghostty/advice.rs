//! Differences that Ghostty makes to a custom shader that compiles: uniforms that it leaves alone, and lines that are Eddy's.

use crate::{PassId, Project, custom_uniforms, includes, lines::hash_lines};
use eddy_diag::{Diagnostic, Severity, Span};

/// Uniforms that Ghostty declares and does not set, with the value that they keep and what to use.
const UNSET: [(&str, &str, &str); 6] = [
    ("iMouse", "vec4(0.0)", "there is no mouse in a custom shader"),
    ("iDate", "vec4(0.0)", "use iTime"),
    ("iFrameRate", "60.0", "use iTimeDelta"),
    ("iChannelTime", "0.0", "use iTime"),
    ("iSampleRate", "0.0", "there is no sound in a custom shader"),
    (
        "iPreviousCursorStyle",
        "what it was when the terminal last drew",
        "it is the same as iCurrentCursorStyle most of the time",
    ),
];

/// Returns what to say of the Image pass, whose text is the custom shader.
pub fn advice(project: &Project) -> Vec<Diagnostic> {
    let Some(index) = project.passes.iter().position(|pass| pass.id == PassId::Image) else { return Vec::new() };
    let (id, text) = (Project::pass_id(index), &*project.passes[index].source.text);
    let mut found = Vec::new();
    for line in hash_lines(text) {
        let said = if custom_uniforms::is_declaration(&line) {
            ("Ghostty does not know #iUniform lines", "write a `const` in its place")
        } else if includes::is_named(&line) {
            ("Ghostty includes no files", "paste the text of the file in place of this line")
        } else if line.body.starts_with("iChannel") {
            ("Ghostty does not know #iChannel lines", "remove it: iChannel0 is the terminal")
        } else {
            continue;
        };
        found.push(Diagnostic::error(Span::new(id, line.range.clone()), said.0).hint(said.1));
    }
    for (name, value, instead) in UNSET {
        if let Some(at) = word(text, name) {
            let message = format!("Ghostty does not set `{name}`: it is {value}");
            found.push(Diagnostic::new(Severity::Note, Span::new(id, at..at + name.len()), message).hint(instead));
        }
    }
    found
}

/// Returns whether a word stands in a text outside of comments.
pub fn names_word(text: &str, name: &str) -> bool {
    word(text, name).is_some()
}

/// Returns where a word stands first outside of comments.
pub(crate) fn word(text: &str, word: &str) -> Option<usize> {
    let is_letter = |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text.as_bytes()[at..];
        if rest.starts_with(b"//") {
            at += rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        } else if rest.starts_with(b"/*") {
            at += rest.windows(2).skip(2).position(|two| two == b"*/").map_or(rest.len(), |end| end + 4);
        } else {
            let is_whole = rest.starts_with(word.as_bytes())
                && !is_letter(at.checked_sub(1).and_then(|i| bytes.get(i)))
                && !is_letter(rest.get(word.len()));
            if is_whole {
                return Some(at);
            }
            at += 1;
        }
    }
    None
}
