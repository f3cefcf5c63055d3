//! The `xshadertoy` module of XScreenSaver, and the projects that it accepts. Source: `hacks/glx/xshadertoy.c` and its
//! manual (<https://www.jwz.org/xscreensaver/>).
//!
//! It runs up to four buffers and Image, each from a file, in the order of its options `--program0` to `--program4`.
//! Channel N of every program reads the picture of program N; no other inputs exist, and a program cannot read its own
//! previous frame.

use super::{
    Filter, InputKind, PassName, Project, Wrap, custom_uniforms, includes, lines::hash_lines, words::find_word,
};
use eddy_diag::{Diagnostic, Severity, Span};

/// The number of buffers that it runs.
const BUFFERS: usize = 4;

/// Uniforms that it declares but does not set, and Shadertoy names that it lacks.
const UNSET: [&str; 3] = ["iChannelTime", "iChannelResolution", "iSampleRate"];
const MISSING: [&str; 6] = ["iGlobalTime", "iCh0", "iCh1", "iCh2", "iCh3", "st_assert"];

/// Returns errors for what XScreenSaver rejects in a project that compiles, and warnings and notes for what differs.
pub fn advice(project: &Project) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let buffers: Vec<&PassName> = project.passes.iter().map(|pass| &pass.id).filter(|id| id.is_buffer()).collect();
    if buffers.len() > BUFFERS {
        let message = format!("XScreenSaver runs {BUFFERS} buffers, and the project has {}", buffers.len());
        found.push(Diagnostic::error(None, message).hint("draw some of them in one pass"));
    }
    if !project.groups.is_empty() {
        found.push(Diagnostic::error(None, "XScreenSaver draws each pass once a frame").hint("remove the groups"));
    }
    for (index, pass) in project.passes.iter().enumerate() {
        let title = pass.id.title();
        if !(pass.id.is_buffer() || pass.id.is_image()) {
            let message = format!("XScreenSaver has no {title} pass");
            found.push(Diagnostic::error(None, message).hint("remove it"));
            continue;
        }
        let settings = &pass.settings;
        let is_plain = pass.body.is_screen()
            && settings.size == Default::default()
            && settings.region.is_none()
            && settings.initial.is_none()
            && settings.boundary.is_none();
        if !is_plain {
            let message = format!("{title} is drawn by settings that XScreenSaver does not have");
            found.push(Diagnostic::error(None, message).hint("draw the whole picture, and no meshes"));
        }
        let own = buffers.iter().position(|id| **id == pass.id).unwrap_or(buffers.len());
        for (n, channel) in pass.bindings.iter() {
            let of = channel.input.target().and_then(|(id, _)| buffers.iter().position(|known| *known == id));
            let (message, hint) = match of {
                None => {
                    let what = channel.input.row().title;
                    let what =
                        if channel.input.kind() == InputKind::Buffer { "a buffer that is not there" } else { what };
                    let message =
                        format!("iChannel{n} of {title} reads {what}: XScreenSaver gives outputs of programs alone");
                    (message, "compute it in a buffer".to_owned())
                }
                Some(of) if of >= own => {
                    let message = format!("iChannel{n} of {title} reads the previous frame");
                    (message, "XScreenSaver keeps nothing from frame to frame".to_owned())
                }
                Some(of) if of != n => {
                    let message =
                        format!("iChannel{n} of {title} reads program {of}, which XScreenSaver gives in iChannel{of}");
                    (message, format!("read it in iChannel{of}"))
                }
                Some(_) => {
                    let sampler = channel.sampler();
                    if sampler.filter != Filter::Nearest || sampler.wrap != Wrap::Clamp {
                        let message = format!(
                            "XScreenSaver reads iChannel{n} of {title} by the nearest texel, clamped at the edges"
                        );
                        found.push(Diagnostic::new(Severity::Note, None, message));
                    }
                    continue;
                }
            };
            found.push(Diagnostic::error(None, message).hint(hint));
        }
        texts(&mut found, (Project::pass_id(index), &pass.source.text));
    }
    if let Some(common) = &project.common {
        texts(&mut found, (Project::COMMON_ID, &common.text));
    }
    found
}

/// Adds the diagnostics about a text.
fn texts(found: &mut Vec<Diagnostic>, (id, text): (eddy_diag::SourceId, &str)) {
    for line in hash_lines(text) {
        let said = if custom_uniforms::is_declaration(&line) {
            ("XScreenSaver does not know #iUniform lines", "write a `const` in its place")
        } else if includes::is_named(&line) {
            ("XScreenSaver includes no files", "paste the text of the file in place of this line")
        } else if line.body.starts_with("iChannel") {
            ("XScreenSaver does not know #iChannel lines", "remove it: channel N is the output of program N")
        } else {
            continue;
        };
        found.push(Diagnostic::error(Span::new(id, line.range.clone()), said.0).hint(said.1));
    }
    let place = |name: &str| find_word(text, name).map(|at| Span::new(id, at..at + name.len()));
    for (name, at) in MISSING.iter().filter_map(|name| Some((name, place(name)?))) {
        found.push(Diagnostic::error(at, format!("XScreenSaver has no `{name}`")));
    }
    for (name, at) in UNSET.iter().filter_map(|name| Some((name, place(name)?))) {
        found.push(Diagnostic::warning(at, format!("XScreenSaver does not set `{name}`: it is 0")));
    }
    if let Some(at) = place("iDate") {
        let message = "XScreenSaver counts the month of `iDate` from 1, Shadertoy from 0";
        found.push(Diagnostic::new(Severity::Note, at, message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channel, Input, Origin, Pass, Source};

    fn pass(id: PassName, reads: &[(usize, Input)], text: &str) -> Pass {
        let mut pass = Pass::new(id.clone(), Source { name: id.title(), path: None, text: text.into() });
        for (n, input) in reads {
            pass.bindings.set(*n, Some(Channel::new(input.clone())));
        }
        pass
    }

    fn said(image: Pass, buffers: Vec<Pass>) -> Vec<String> {
        let project = Project::new("p", buffers.into_iter().chain([image]).collect(), Origin::Unsaved);
        advice(&project).into_iter().map(|d| format!("{}: {}", d.severity.name(), d.message)).collect()
    }

    fn buffer(name: &str, reads: &[(usize, Input)]) -> Pass {
        pass(PassName::buffer(name), reads, "")
    }

    #[test]
    fn a_chain_of_buffers_is_accepted() {
        let image = pass(PassName::image(), &[(0, Input::buffer("A")), (1, Input::buffer("B"))], "float t = iTime;");
        let all = said(image, vec![buffer("A", &[]), buffer("B", &[(0, Input::buffer("A"))])]);
        assert!(all.iter().all(|line| line.starts_with("note: ")), "{all:?}");
        assert_eq!(all.len(), 3, "{all:?}");
    }

    #[test]
    fn unsupported_features_are_errors() {
        let image = |reads: &[(usize, Input)], text: &str| pass(PassName::image(), reads, text);
        let cases: [(Pass, Vec<Pass>, &str); 9] = [
            (image(&[(0, Input::KEYBOARD)], ""), vec![], "error: iChannel0 of Image reads Keyboard"),
            (
                image(&[(1, Input::buffer("A"))], ""),
                vec![buffer("A", &[])],
                "error: iChannel1 of Image reads program 0",
            ),
            (
                image(&[], ""),
                vec![buffer("A", &[(0, Input::buffer("A"))])],
                "error: iChannel0 of Buffer A reads the previous frame",
            ),
            (image(&[], ""), vec![pass(PassName::sound(), &[], "")], "error: XScreenSaver has no Sound pass"),
            (
                image(&[], ""),
                ["A", "B", "C", "D", "e"].map(|n| buffer(n, &[])).to_vec(),
                "error: XScreenSaver runs 4 buffers",
            ),
            (image(&[], "#iUniform float x = 1.0"), vec![], "error: XScreenSaver does not know #iUniform"),
            (image(&[], "float t = iGlobalTime; // iCh0"), vec![], "error: XScreenSaver has no `iGlobalTime`"),
            (image(&[], "float t = iSampleRate;"), vec![], "warning: XScreenSaver does not set `iSampleRate`"),
            (image(&[], "float t = iDate.y;"), vec![], "note: XScreenSaver counts the month"),
        ];
        for (image, buffers, wanted) in cases {
            let all = said(image, buffers);
            assert!(all.len() == 1 && all[0].starts_with(wanted), "{wanted}\n{all:?}");
        }
    }
}
