//! One `#iChannel` line: its parts, the input that it names, and the sampler setting that it makes.

use super::around::DirectiveScope;
use crate::{
    Channel, FileKind, Filter, Input, InputKind, InputSource, Media, PassName, SLOTS, Wrap, file_names, kind_of_file,
    lines::{HashLine, trim_start},
    listed, nearest,
};
use eddy_diag::{Diagnostic, Span};
use std::path::{Path, PathBuf};

/// The channel, the setting if there is one, and the quoted text.
type Parsed<'a> = (usize, Option<&'a str>, &'a str);

pub(super) fn parse<'a>(line: &HashLine<'a>) -> Result<Parsed<'a>, impl FnOnce(Span) -> Diagnostic + use<>> {
    let error = |message: String| {
        Err(move |span: Span| {
            Diagnostic::error(span, message).hint("write #iChannel0 \"buffer_a\", or #iChannel0::WrapMode \"Repeat\"")
        })
    };
    let rest = line.body.strip_prefix("iChannel").unwrap_or_default();
    let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let (number, rest) = rest.split_at(digits);
    let Some(n) = number.parse::<usize>().ok().filter(|n| *n < SLOTS) else {
        return error(format!("there is no iChannel{number}: a pass has iChannel0 to iChannel3"));
    };
    let (setting, rest) = match rest.strip_prefix("::") {
        Some(after) => {
            let end = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
            (Some(&after[..end]), &after[end..])
        }
        None => (None, rest),
    };
    let quoted = trim_start(rest).strip_prefix('"').and_then(|r| r.split_once('"'));
    match quoted {
        Some((value, after)) if is_end(after) => Ok((n, setting, value.trim())),
        _ => error("a channel directive needs one string in double quotes".into()),
    }
}

/// Returns whether only a comment follows.
fn is_end(after: &str) -> bool {
    let after = trim_start(after);
    after.is_empty() || after.starts_with("//") || after.starts_with("/*")
}

/// Returns the path if a text names a GLSL file, as `"file://noise.glsl"` and `"noise.glsl"` do.
pub(super) fn glsl_path(value: &str) -> Option<&str> {
    let path = value.strip_prefix("file://").unwrap_or(value);
    let is_url = path.contains("://");
    (!is_url && is_glsl(path)).then_some(path)
}

fn is_glsl(path: &str) -> bool {
    Path::new(path).extension().is_some_and(file_names::is_glsl_extension)
}

/// Returns the channel that a text declares, or `None` after reporting an error.
pub(super) fn input(
    value: &str,
    around: DirectiveScope<'_>,
    span: Span,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Channel> {
    // The extension decides the kind; an animated image plays only with a `Type` line.
    let picture = |path: &str| {
        let kind = match kind_of_file(Path::new(path)) {
            FileKind::Video => InputKind::Video,
            FileKind::Sound => InputKind::Music,
            _ => InputKind::Texture,
        };
        Some(Channel::new(Input::Media { kind, media: Media::File(PathBuf::from(path)) }))
    };
    if let Some(name) = value.strip_prefix("builtin://") {
        return Some(Channel::new(Input::texture(Media::Builtin(name.to_owned()))));
    }
    if value.starts_with("http://") || value.starts_with("https://") {
        diagnostics.push(
            Diagnostic::warning(span, "images from the network are not downloaded; the channel reads black")
                .hint("save the image next to the shader and write \"file://pic.png\""),
        );
        return None;
    }
    let (path, is_file) = match value.strip_prefix("file://") {
        Some(path) => (path.trim(), true),
        None => (value, false),
    };
    let is_glsl = is_glsl(path);
    let file = Path::new(path);
    let word = if is_glsl { file.file_stem().and_then(|s| s.to_str()).unwrap_or_default() } else { path };
    // The extension's older spelling of "self".
    if path.eq_ignore_ascii_case("self") {
        return pass(around.id, around, span, diagnostics);
    }
    if let Some(id) = around.pass_of(path) {
        return pass(id, around, span, diagnostics);
    }
    if is_glsl && word.eq_ignore_ascii_case("self") {
        return pass(around.id, around, span, diagnostics);
    }
    if is_file && !is_glsl && !path.is_empty() {
        return picture(path);
    }
    let device = InputKind::find(|row| {
        row.source == InputSource::Device && row.directive.is_some_and(|own| word.eq_ignore_ascii_case(own))
    });
    if let Some(device) = device {
        return Some(Channel::new(Input::Device(device)));
    }
    match file_names::pass_of_stem(word) {
        Some(id) if is_glsl && !around.passes.iter().any(|(_, known)| *known == id) => {
            let files = around.passes.iter().map(|(file, _)| file.as_str());
            let mut diagnostic = Diagnostic::error(span, format!("{path} is not a pass of this project"));
            if let Some(near) = nearest(path, files) {
                diagnostic = diagnostic.hint(format!("did you mean \"{near}\"?"));
            }
            diagnostics.push(diagnostic.hint("put the file there and reopen the project"));
            return None;
        }
        Some(id) => return pass(&id, around, span, diagnostics),
        None => {}
    }
    if !is_glsl && file.extension().is_some() {
        return picture(path);
    }
    let words: Vec<&str> = InputKind::all().filter_map(|kind| kind.row().directive).collect();
    let known = words.iter().copied().chain(["self", "buffer_a", "buffer_b", "buffer_c", "buffer_d"]);
    let mut diagnostic = Diagnostic::error(span, format!("\"{value}\" is not an input that a channel can read"));
    if let Some(near) = nearest(word, known) {
        diagnostic = diagnostic.hint(format!("did you mean \"{near}\"?"));
    }
    let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    diagnostics.push(diagnostic.hint(format!(
        "a channel reads \"buffer_a\", \"self\", {}, \"file://pic.png\", \"file://song.mp3\" or \
         \"builtin://noise-rgba-256\"",
        quoted.join(", ")
    )));
    None
}

/// Returns the channel that reads a pass.
fn pass(id: &PassName, around: DirectiveScope<'_>, span: Span, diagnostics: &mut Vec<Diagnostic>) -> Option<Channel> {
    let (message, hint) = match id.row().input {
        Some(_) => return Some(Channel::new(Input::pass(id.clone()))),
        None if id == around.id => {
            (format!("{} cannot read itself", id.title()), "move the feedback into buffer_a.glsl and read \"buffer_a\"")
        }
        None => (
            format!("a channel cannot read {}", id.title()),
            "a channel can read buffers, the cubemap pass, image files and the keyboard",
        ),
    };
    diagnostics.push(Diagnostic::error(span, message).hint(hint));
    None
}

pub(super) fn set(channel: &mut Channel, setting: &str, value: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) {
    let Channel { input, sampler } = channel;
    let mut unknown = |what: &str, got: &str, known: &[&'static str]| {
        let mut d = Diagnostic::error(span, format!("unknown {what} {got}"));
        if let Some(near) = nearest(got, known.iter().copied()) {
            d = d.hint(format!("did you mean {near}?"));
        }
        diagnostics.push(d.hint(format!("the values are {}", listed(known))));
    };
    let folded = value.to_lowercase();
    match setting.to_lowercase().as_str() {
        // MinFilter decides whether mipmaps are used; MagFilter only chooses between nearest and linear.
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
        "type" => match folded.as_str() {
            "texture2d" => {}
            "video" => match input {
                Input::Media { kind: kind @ (InputKind::Texture | InputKind::Video), .. } => *kind = InputKind::Video,
                _ => diagnostics.push(
                    Diagnostic::error(span, "only a file can be a video").hint("name one: #iChannel0 \"clip.gif\""),
                ),
            },
            "cubemap" => diagnostics.push(
                Diagnostic::error(span, "a channel directive cannot read a cubemap of six images")
                    .hint("for the cubemap pass write #iChannel0 \"cube_a\"; for an image remove this line"),
            ),
            _ => unknown("type", value, &["Texture2D", "Video"]),
        },
        _ => unknown("setting", setting, &["MinFilter", "MagFilter", "WrapMode", "VFlip", "Type"]),
    }
}
