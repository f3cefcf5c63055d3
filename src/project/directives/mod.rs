//! `#iChannelN "…"` lines: GLSL texts that declare the inputs of their channels.
//!
//! Owns the parsing of these lines, in the form the VS Code extension "Shader Toy" made common, and their removal
//! before compilation. They count only if the project has no `eddy.toml`. This is not a preprocessor: it knows
//! comments, but not conditionals.
//!
//! ```glsl
//! #iChannel0 "buffer_a"               // a buffer, by pass or file name; also "file://buffer_a.glsl"
//! #iChannel0 "self"                   // the pass itself; also "file://self", and the file's own name
//! #iChannel1 "cube_a"                 // the cubemap pass
//! #iChannel1 "keyboard"
//! #iChannel2 "file://pic.png"         // a picture, relative to the project's folder; also "pic.png"
//! #iChannel2 "clip.mp4"               // a video, by its ending
//! #iChannel2::Type "Video"            // plays an animated image, too
//! #iChannel2 "webcam"
//! #iChannel2 "file://song.mp3"        // music, by its ending; also "song.mp3"
//! #iChannel2 "microphone"
//! #iChannel3 "builtin://noise-rgba-256"
//! #iChannel3::MinFilter "NearestMipMapLinear"   // anything with MipMap: linear, between mip levels too
//! #iChannel3::MagFilter "Nearest"
//! #iChannel3::WrapMode "Clamp"        // or "Repeat"
//! ```
//!
//! Every parsed line takes effect, or is reported as an error or a warning ([`read`], and [`ignored_channel_lines`] for
//! the texts in which these lines have no effect).

mod around;
mod ignored;
mod line;
mod passes_beside;
mod read;

use super::{Source, custom_uniforms, includes, lines::hash_lines};
pub(super) use around::{DirectiveScope, files_of_passes};
pub use ignored::ignored_channel_lines;
pub(super) use passes_beside::passes_beside;
pub(super) use read::read;
use std::{borrow::Cow, ops::Range};

/// `text` with `#iChannel`, `#iUniform` and `#include` lines and a byte order mark overwritten with spaces, byte for
/// byte. Line breaks stay, and so do `#include` lines that do not name a file: the compiler reports these.
pub fn blank(text: &str) -> Cow<'_, str> {
    let mut ranges: Vec<Range<usize>> = hash_lines(text)
        .into_iter()
        .filter(|l| around::is_channel(l) || custom_uniforms::is_declaration(l) || includes::is_named(l))
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
        for byte in text[range.clone()].bytes() {
            out.push(if matches!(byte, b'\n' | b'\r') { char::from(byte) } else { ' ' });
        }
        done = range.end;
    }
    out.push_str(&text[done..]);
    Cow::Owned(out)
}

/// `text` with its `#iChannel` lines commented out, for Shadertoy, which rejects them.
pub(super) fn commented(text: &str) -> Cow<'_, str> {
    let lines = hash_lines(text).into_iter().filter(around::is_channel);
    let places: Vec<usize> = lines.map(|line| line.body_at).collect();
    if places.is_empty() {
        return Cow::Borrowed(text);
    }
    let (mut out, mut done) = (String::with_capacity(text.len() + 3 * places.len()), 0);
    for body in places {
        let hash = text[..body].rfind('#').unwrap_or(body);
        out.push_str(&text[done..hash]);
        out.push_str("// ");
        done = hash;
    }
    out.push_str(&text[done..]);
    Cow::Owned(out)
}

impl Source {
    /// Returns the text for the compiler: every `#iChannel`, `#iUniform` and `#include` line (see the module's docs)
    /// and a byte order mark are overwritten with spaces, byte for byte, so that offsets and lines are those of `text`.
    pub fn compile_text(&self) -> Cow<'_, str> {
        blank(&self.text)
    }
}

#[cfg(test)]
mod tests;
