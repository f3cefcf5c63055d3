//! Differences between Ghostty and Eddy for a custom shader that compiles: uniforms that Ghostty does not set, and
//! lines that only Eddy reads.

use crate::{Pass, Project, custom_uniforms, includes, lines::hash_lines, words::find_word};
use eddy_diag::{Diagnostic, Severity, SourceId, Span};

/// Uniforms that Ghostty declares but does not set, with the value that they keep and what to use instead.
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

/// Returns diagnostics about the passes whose texts are custom shaders.
pub fn advice(project: &Project) -> Vec<Diagnostic> {
    let is_shader = |pass: &Pass| pass.id.is_image() || pass.source.path.is_some();
    let shaders = project.passes.iter().enumerate().filter(|(_, pass)| is_shader(pass));
    shaders.flat_map(|(index, pass)| advice_about(Project::pass_id(index), &pass.source.text)).collect()
}

fn advice_about(id: SourceId, text: &str) -> Vec<Diagnostic> {
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
        if let Some(at) = find_word(text, name) {
            let message = format!("Ghostty does not set `{name}`: it is {value}");
            found.push(Diagnostic::new(Severity::Note, Span::new(id, at..at + name.len()), message).hint(instead));
        }
    }
    found
}
