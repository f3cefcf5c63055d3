//! `#iChannelN "…"` lines: what a channel reads, said in the GLSL text itself.
//!
//! Owns the reading of these lines, in the form the VS Code extension "Shader Toy" made common, and their removal
//! before a compiler sees the text. They count only where there is no `eddy.toml`. Not a preprocessor: it knows
//! comments, and no conditionals.
//!
//! ```glsl
//! #iChannel0 "buffer_a"               // a buffer, by pass or file name; also "file://buffer_a.glsl"
//! #iChannel0 "self"                   // the pass itself
//! #iChannel1 "cube_a"                 // the cubemap pass
//! #iChannel1 "keyboard"
//! #iChannel2 "file://pic.png"         // a picture, relative to the project's folder; also "pic.png"
//! #iChannel3 "builtin://noise-rgba-256"
//! #iChannel3::MinFilter "NearestMipMapLinear"   // anything with MipMap: linear, between mip levels too
//! #iChannel3::MagFilter "Nearest"
//! #iChannel3::WrapMode "Clamp"        // or "Repeat"
//! ```

use super::{
    Channel, Filter, Input, Media, PassId, Sampler, Source, Wrap, custom_uniforms, file_names, includes,
    lines::{HashLine, hash_lines},
    nearest,
};
use crate::diag::{Diagnostic, SourceId, Span};
use std::{borrow::Cow, ops::Range, path::PathBuf};

fn is_channel(line: &HashLine<'_>) -> bool {
    line.body.strip_prefix("iChannel").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// `text` with `#iChannel`, `#iUniform` and `#include` lines and a byte order mark overwritten with spaces, byte for
/// byte.
pub fn blank(text: &str) -> Cow<'_, str> {
    let mut ranges: Vec<Range<usize>> = hash_lines(text)
        .into_iter()
        .filter(|l| is_channel(l) || custom_uniforms::is_declaration(l) || includes::is_include(l))
        .map(|l| l.range)
        .collect();
    if text.starts_with('\u{feff}') {
        ranges.insert(0, 0..'\u{feff}'.len_utf8());
    }
    if ranges.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    for range in ranges {
        let range = range.start.max(done)..range.end;
        out.push_str(&text[done..range.start]);
        out.extend(std::iter::repeat_n(' ', range.len()));
        done = range.end;
    }
    out.push_str(&text[done..]);
    Cow::Owned(out)
}

/// The directives of one pass.
#[derive(Debug, Default)]
pub(super) struct Declared {
    /// `None` where the text has no directive at all.
    pub channels: Option<[Option<Channel>; 4]>,
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads the directives of the pass `id`.
pub(super) fn read(text: &str, source: SourceId, id: &PassId) -> Declared {
    let mut found = Declared::default();
    // Inputs first, settings after: a setting may stand above the line that names the input.
    let mut settings = Vec::new();
    let mut channels: [Option<Channel>; 4] = Default::default();
    for line in hash_lines(text).into_iter().filter(is_channel) {
        let span = Span::new(source, line.range.clone());
        match parse(&line) {
            Ok((n, None, value)) => {
                found.channels.get_or_insert_default();
                channels[n] = input(value, id, span, &mut found.diagnostics);
            }
            Ok((n, Some(setting), value)) => settings.push((n, setting, value, span)),
            Err(diagnostic) => found.diagnostics.push(diagnostic(span)),
        }
    }
    for (n, setting, value, span) in settings {
        match &mut channels[n] {
            Some(channel) => set(&mut channel.sampler, setting, value, span, &mut found.diagnostics),
            None => found.diagnostics.push(
                Diagnostic::warning(span, format!("iChannel{n} reads nothing, so this line sets nothing"))
                    .hint(format!("name what it reads: #iChannel{n} \"buffer_a\"")),
            ),
        }
    }
    if found.channels.is_some() {
        found.channels = Some(channels);
    }
    found
}

type Parsed<'a> = (usize, Option<&'a str>, &'a str);

fn parse<'a>(line: &HashLine<'a>) -> Result<Parsed<'a>, impl FnOnce(Span) -> Diagnostic + use<>> {
    let error = |message: String| {
        Err(move |span: Span| {
            Diagnostic::error(span, message)
                .hint("the form is #iChannel0 \"buffer_a\", or #iChannel0::WrapMode \"Repeat\"")
        })
    };
    let rest = line.body.strip_prefix("iChannel").unwrap_or_default();
    let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let (number, rest) = rest.split_at(digits);
    let Some(n) = number.parse::<usize>().ok().filter(|n| *n < 4) else {
        return error(format!("there is no iChannel{number}: a pass has iChannel0 to iChannel3"));
    };
    let (setting, rest) = match rest.strip_prefix("::") {
        Some(after) => {
            let end = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
            (Some(&after[..end]), &after[end..])
        }
        None => (None, rest),
    };
    let quoted = rest.trim_start().strip_prefix('"').and_then(|r| r.split_once('"'));
    match quoted {
        Some((value, after)) if after.trim().is_empty() || after.trim_start().starts_with('/') => {
            Ok((n, setting, value.trim()))
        }
        _ => error("a channel directive needs one text in double quotes".into()),
    }
}

fn input(value: &str, id: &PassId, span: Span, diagnostics: &mut Vec<Diagnostic>) -> Option<Channel> {
    let with = |input, sampler| Some(Channel { input, sampler });
    let picture = |path: &str| with(Input::Texture(Media::File(PathBuf::from(path))), Sampler::TEXTURE);
    if let Some(name) = value.strip_prefix("builtin://") {
        return with(Input::Texture(Media::Builtin(name.to_owned())), Sampler::TEXTURE);
    }
    if value.starts_with("http://") || value.starts_with("https://") {
        diagnostics.push(
            Diagnostic::warning(span, "a picture from the network is not fetched; the channel reads black")
                .hint("save the picture beside the shader and name it: \"file://pic.png\""),
        );
        return None;
    }
    let (path, is_file) = match value.strip_prefix("file://") {
        Some(path) => (path, true),
        None => (value, false),
    };
    let file = std::path::Path::new(path);
    let is_glsl = file.extension().is_some_and(file_names::is_glsl_extension);
    let word = if is_glsl { file.file_stem().and_then(|s| s.to_str()).unwrap_or_default() } else { path };
    if is_file && !is_glsl {
        return picture(path);
    }
    match word.to_lowercase().as_str() {
        "self" => match id {
            PassId::Buffer(name) => return with(Input::Buffer(name.clone()), Sampler::BUFFER),
            PassId::Cubemap => return with(Input::CubemapPass, Sampler::BUFFER),
            PassId::Image | PassId::Sound => {
                diagnostics.push(
                    Diagnostic::error(span, format!("{} cannot read itself", id.title()))
                        .hint("move the feedback into buffer_a.glsl and read \"buffer_a\""),
                );
                return None;
            }
        },
        "keyboard" => return with(Input::Keyboard, Sampler::KEYBOARD),
        _ => {}
    }
    match file_names::pass_of_stem(word) {
        Some(PassId::Buffer(name)) => return with(Input::Buffer(name), Sampler::BUFFER),
        Some(PassId::Cubemap) => return with(Input::CubemapPass, Sampler::BUFFER),
        Some(other) => {
            diagnostics.push(
                Diagnostic::error(span, format!("a channel cannot read {}", other.title()))
                    .hint("only buffers, the cubemap pass, pictures and the keyboard can be read"),
            );
            return None;
        }
        None => {}
    }
    if !is_glsl && file.extension().is_some() {
        return picture(path);
    }
    let known = ["self", "keyboard", "cube_a", "buffer_a", "buffer_b", "buffer_c", "buffer_d"];
    let mut diagnostic = Diagnostic::error(span, format!("\"{value}\" is nothing a channel can read"));
    if let Some(near) = nearest(word, known) {
        diagnostic = diagnostic.hint(format!("did you mean \"{near}\"?"));
    }
    diagnostics.push(diagnostic.hint(
        "a channel reads \"buffer_a\", \"self\", \"cube_a\", \"keyboard\", \"file://pic.png\" or \
        \"builtin://noise-rgba-256\"",
    ));
    None
}

fn set(sampler: &mut Sampler, setting: &str, value: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) {
    let mut unknown = |what: &str, got: &str, known: &[&'static str]| {
        let mut d = Diagnostic::error(span, format!("unknown {what} {got}"));
        if let Some(near) = nearest(got, known.iter().copied()) {
            d = d.hint(format!("did you mean {near}?"));
        }
        diagnostics.push(d.hint(format!("known are {}", super::listed(known))));
    };
    let folded = value.to_lowercase();
    match setting.to_lowercase().as_str() {
        // Min decides between mipmap and not; Mag says no more than nearest or linear.
        "minfilter" => match folded.as_str() {
            f if f.contains("mipmap") => sampler.filter = Filter::Mipmap,
            "nearest" => sampler.filter = Filter::Nearest,
            "linear" => sampler.filter = Filter::Linear,
            _ => unknown(
                "filter",
                value,
                &[
                    "Nearest",
                    "Linear",
                    "NearestMipMapNearest",
                    "LinearMipMapNearest",
                    "NearestMipMapLinear",
                    "LinearMipMapLinear",
                ],
            ),
        },
        "magfilter" | "maxfilter" => match folded.as_str() {
            "nearest" if sampler.filter != Filter::Mipmap => sampler.filter = Filter::Nearest,
            "nearest" | "linear" => {}
            _ => unknown("filter", value, &["Nearest", "Linear"]),
        },
        "wrapmode" => match folded.as_str() {
            "clamp" => sampler.wrap = Wrap::Clamp,
            "repeat" => sampler.wrap = Wrap::Repeat,
            _ => unknown("wrap mode", value, &["Clamp", "Repeat"]),
        },
        "vflip" => match folded.as_str() {
            "true" => sampler.vflip = true,
            "false" => sampler.vflip = false,
            _ => unknown("vertical flip", value, &["true", "false"]),
        },
        _ => unknown("setting", setting, &["MinFilter", "MagFilter", "WrapMode", "VFlip"]),
    }
}

impl Source {
    /// Returns what a compiler gets: the text with every `#iChannel`, `#iUniform` and `#include` line (see the module's
    /// page) and a byte order mark overwritten with spaces, byte for byte, so that offsets and lines are those of
    /// `text`.
    pub fn compile_text(&self) -> Cow<'_, str> {
        blank(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channels(text: &str) -> [Option<Channel>; 4] {
        let d = read(text, SourceId(1), &PassId::Buffer("A".into()));
        assert_eq!(d.diagnostics, []);
        d.channels.unwrap()
    }

    #[test]
    fn directives_name_inputs_and_samplers() {
        let c = channels(
            "#iChannel0::WrapMode \"Repeat\"\n#iChannel0 \"self\"\n#iChannel1 \"file://sub/pic.png\" // note\n\
             #iChannel1::MinFilter \"Nearest\"\r\n#iChannel2 \"keyboard\"\n#iChannel3 \"file://Buffer_B.glsl\"\n",
        );
        assert_eq!(
            c[0],
            Some(Channel {
                input: Input::Buffer("A".into()),
                sampler: Sampler { wrap: Wrap::Repeat, ..Sampler::BUFFER }
            })
        );
        assert_eq!(
            c[1],
            Some(Channel {
                input: Input::Texture(Media::File("sub/pic.png".into())),
                sampler: Sampler { filter: Filter::Nearest, ..Sampler::TEXTURE }
            })
        );
        assert_eq!(c[2].as_ref().unwrap().input, Input::Keyboard);
        assert_eq!(c[3].as_ref().unwrap().input, Input::Buffer("B".into()));
    }

    #[test]
    fn a_text_without_directives_declares_nothing() {
        let d = read("/*\n#iChannel0 \"self\"\n*/ // #iChannel1 \"self\"\nvoid f(){}", SourceId(1), &PassId::Image);
        assert!(d.channels.is_none() && d.diagnostics.is_empty());
    }

    #[test]
    fn blanking_keeps_every_other_byte_where_it_was() {
        let text = "\u{feff}a\n#iChannel0 \"file://é.png\"\r\nb // #iChannel0\n#define iChannel0 x\n";
        let out = blank(text);
        assert_eq!(out.len(), text.len());
        assert_eq!(out.find("\r\nb // #iChannel0\n#define"), text.find("\r\nb // #iChannel0\n#define"));
        assert!(!out.contains(".png") && !out.contains('\u{feff}'));
        assert!(matches!(blank("plain\n#define X\n"), Cow::Borrowed(_)));
        assert_eq!(blank("\u{feff}#iChannel0 \"self\"").trim(), "");
    }

    #[test]
    fn a_wrong_directive_says_where_and_how_to_mend_it() {
        for (line, message, hint) in [
            ("#iChannel4 \"self\"", "there is no iChannel4", "the form is"),
            ("#iChannel0 self", "double quotes", "the form is"),
            ("#iChannel0 \"self", "double quotes", "the form is"),
            ("#iChannel0 \"keybord\"", "nothing a channel can read", "keyboard"),
            ("#iChannel0 \"image\"", "cannot read Image", "only buffers"),
            ("#iChannel0 \"https://x/y.png\"", "not fetched", "file://pic.png"),
            ("#iChannel0 \"self\"\n#iChannel0::WrapMode \"Mirror\"", "unknown wrap mode", "Clamp and Repeat"),
            ("#iChannel0 \"self\"\n#iChannel0::WrapMod \"Clamp\"", "unknown setting", "WrapMode"),
            ("#iChannel0::WrapMode \"Clamp\"", "reads nothing", "name what it reads"),
        ] {
            let text = format!("\n{line}");
            let d = read(&text, SourceId(3), &PassId::Buffer("A".into())).diagnostics;
            assert_eq!(d.len(), 1, "{line}: {d:?}");
            assert!(d[0].message.contains(message), "{line}: {}", d[0].message);
            assert!(d[0].hints.iter().any(|h| h.contains(hint)), "{line}: {:?}", d[0].hints);
            let span = d[0].span.unwrap();
            assert!(text[span.range()].starts_with("#iChannel") && span.source == SourceId(3));
        }
    }
}
