//! Calls that read channels: `texture(iChannel0, at)` becomes `IMG_NORM_PIXEL(image, at)`. ISF hosts search the text
//! for these calls, so each of them must contain the name of the image.

use super::{SlotImages, refused};
use eddy_diag::{Diagnostic, SourceId, Span};
use eddy_project::{Bindings, Channel, Filter, SLOTS, Wrap};
use std::ops::Range;

/// A text whose calls are replaced.
pub(super) struct Reads<'t> {
    text: &'t str,
    /// The text with comments replaced by spaces, byte for byte.
    code: Vec<u8>,
    id: SourceId,
    images: &'t SlotImages,
    bindings: &'t Bindings,
    pub found: Vec<Diagnostic>,
}

const CHANNEL: &str = "iChannel";

impl<'t> Reads<'t> {
    pub(super) fn new((text, id): (&'t str, SourceId), images: &'t SlotImages, bindings: &'t Bindings) -> Self {
        Self { text, code: without_comments(text), id, images, bindings, found: Vec::new() }
    }

    /// Returns the text with every read of a channel replaced by one of its image.
    pub(super) fn replaced(&mut self) -> String {
        self.part(0..self.text.len())
    }

    fn word(&self, range: Range<usize>) -> &str {
        &self.text[range]
    }

    /// Returns the word at a position of the code, if one starts there.
    fn word_at(&self, at: usize) -> Option<Range<usize>> {
        let is_letter = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
        let is_start = is_letter(*self.code.get(at)?) && (at == 0 || !is_letter(self.code[at - 1]));
        let end = (at..self.code.len()).find(|&i| !is_letter(self.code[i])).unwrap_or(self.code.len());
        is_start.then_some(at..end)
    }

    fn part(&mut self, range: Range<usize>) -> String {
        let (mut out, mut at) = (String::new(), range.start);
        while at < range.end {
            let Some(word) = self.word_at(at) else {
                let next = (at + 1..=range.end).find(|&i| self.text.is_char_boundary(i)).unwrap_or(range.end);
                out.push_str(&self.text[at..next]);
                at = next;
                continue;
            };
            match self.call(&word).or_else(|| self.resolution(&word)) {
                Some((text, end)) => {
                    out.push_str(&text);
                    at = end;
                }
                None => {
                    let name = self.word(word.clone());
                    if is_channel(name) {
                        let hint = "read it where it is named: texture(iChannel0, at)";
                        self.refuse(
                            &word,
                            "ISF reads images by name alone: a channel cannot be handed to a function",
                            hint,
                        );
                    }
                    out.push_str(&self.text[word.clone()]);
                    at = word.end;
                }
            }
        }
        out
    }

    fn refuse(&mut self, at: &Range<usize>, message: &str, hint: &str) {
        self.found.push(refused(Span::new(self.id, at.clone()), message, hint));
    }

    fn warn(&mut self, at: &Range<usize>, message: &str) {
        if !self.found.iter().any(|known| known.message == message) {
            self.found.push(Diagnostic::warning(Span::new(self.id, at.clone()), message));
        }
    }

    /// Returns the arguments of the brackets that open at a position, without separators, and the position after them.
    fn arguments(&self, open: usize) -> Option<(Vec<Range<usize>>, usize)> {
        let (mut depth, mut start, mut parts) = (0, open + 1, Vec::new());
        for at in open..self.code.len() {
            match self.code[at] {
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => {
                    depth -= 1;
                    if depth == 0 {
                        parts.push(start..at);
                        return Some((parts, at + 1));
                    }
                }
                b',' if depth == 1 => {
                    parts.push(start..at);
                    start = at + 1;
                }
                _ => {}
            }
        }
        None
    }

    /// Returns the replacement of a call that reads a channel, and the call's end.
    fn call(&mut self, word: &Range<usize>) -> Option<(String, usize)> {
        let name = self.word(word.clone()).to_owned();
        if !matches!(
            name.as_str(),
            "texture" | "textureLod" | "texelFetch" | "textureSize" | "textureGrad" | "textureOffset"
        ) {
            return None;
        }
        let open = (word.end..self.code.len()).find(|&i| !self.code[i].is_ascii_whitespace())?;
        if self.code[open] != b'(' {
            return None;
        }
        let (parts, end) = self.arguments(open)?;
        let first = self.text[parts.first()?.clone()].trim().to_owned();
        let index = channel_index(&first)?;
        let Some(image) = self.images.get(&index).map(|image| image.name().to_owned()) else {
            self.refuse(
                word,
                &format!("{first} has no input, which ISF cannot say"),
                "remove this call: it reads black",
            );
            return Some((String::new(), end));
        };
        let rest: Vec<String> = parts[1..].iter().map(|part| self.part(part.clone()).trim().to_owned()).collect();
        let text = match (name.as_str(), rest.as_slice()) {
            ("texture", [at]) => self.read(index, word, &image, at),
            ("texture" | "textureLod", [at, level]) => {
                if level.parse::<f64>() != Ok(0.0) {
                    self.warn(word, "ISF has no mip levels: the whole image is read");
                }
                self.read(index, word, &image, at)
            }
            ("texelFetch", [at, _]) => format!("IMG_PIXEL({image}, vec2({at}) + 0.5)"),
            ("textureSize", [_]) => format!("ivec2(IMG_SIZE({image}))"),
            _ => {
                self.refuse(word, &format!("ISF has no `{name}`"), "read it with texture(iChannel0, at)");
                String::new()
            }
        };
        Some((text, end))
    }

    fn read(&mut self, index: usize, word: &Range<usize>, image: &str, at: &str) -> String {
        let sampler = self.bindings.get(index).map(Channel::sampler);
        if sampler.is_some_and(|sampler| sampler.filter == Filter::Nearest) {
            self.warn(word, "ISF reads between texels: the filter of this channel is nearest");
        }
        match sampler.is_some_and(|sampler| sampler.wrap == Wrap::Repeat) {
            true => format!("IMG_NORM_PIXEL({image}, fract({at}))"),
            false => format!("IMG_NORM_PIXEL({image}, {at})"),
        }
    }

    /// Returns the replacement of `iChannelResolution[0]`, and its end.
    fn resolution(&mut self, word: &Range<usize>) -> Option<(String, usize)> {
        let name = self.word(word.clone());
        if name != "iChannelResolution" {
            return None;
        }
        let open = (word.end..self.code.len()).find(|&i| !self.code[i].is_ascii_whitespace())?;
        let index = (self.code[open] == b'[').then(|| self.arguments(open)).flatten();
        let number =
            index.as_ref().and_then(|(parts, _)| self.text[parts.first()?.clone()].trim().parse::<usize>().ok());
        let image = number.and_then(|n| self.images.get(&n)).map(|image| image.name().to_owned());
        match (image, index) {
            (Some(image), Some((_, end))) => Some((format!("vec3(IMG_SIZE({image}), 1.0)"), end)),
            _ => {
                let hint = "write the number of a channel that has an input: iChannelResolution[0]";
                self.refuse(word, "ISF gives the size of an image by its name", hint);
                None
            }
        }
    }
}

fn channel_index(name: &str) -> Option<usize> {
    name.strip_prefix(CHANNEL)?.parse().ok().filter(|n| *n < SLOTS)
}

fn is_channel(name: &str) -> bool {
    channel_index(name).is_some()
}

/// Returns the bytes of a text with comments replaced by spaces.
pub(super) fn without_comments(text: &str) -> Vec<u8> {
    let mut out = text.as_bytes().to_vec();
    let mut at = 0;
    while at < out.len() {
        let rest = &out[at..];
        let len = if rest.starts_with(b"//") {
            rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len())
        } else if rest.starts_with(b"/*") {
            rest.windows(2).skip(2).position(|two| two == b"*/").map_or(rest.len(), |end| end + 4)
        } else {
            at += 1;
            continue;
        };
        out[at..at + len].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
        at += len;
    }
    out
}
