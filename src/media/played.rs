//! Recognises sounds and films in place of an image, so that errors do not suggest to repair an intact file.

use std::{fmt, path::Path};

/// A file with a duration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Played {
    Sound,
    Film,
}

impl fmt::Display for Played {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Played::Sound => "a sound file, which does not play as an image",
            Played::Film => "a video file, which does not play as an image",
        })
    }
}

const SOUNDS: [&str; 17] = [
    "mp3", "ogg", "oga", "opus", "wav", "flac", "m4a", "aac", "wma", "aif", "aiff", "aifc", "mid", "midi", "weba",
    "mka", "caf",
];
const FILMS: [&str; 12] = ["mp4", "m4v", "webm", "mov", "mkv", "avi", "ogv", "wmv", "flv", "mpg", "mpeg", "3gp"];

impl Played {
    /// Returns the type of a file by its first bytes, otherwise by its extension if the bytes are not those of a
    /// picture.
    pub fn of(bytes: &[u8], path: &Path) -> Option<Played> {
        by_content(bytes, path).or_else(|| by_ending(path).filter(|_| image::guess_format(bytes).is_err()))
    }
}

fn by_ending(path: &Path) -> Option<Played> {
    let is =
        |endings: &[&str]| path.extension().is_some_and(|e| endings.iter().any(|known| e.eq_ignore_ascii_case(known)));
    if is(&SOUNDS) {
        Some(Played::Sound)
    } else if is(&FILMS) {
        Some(Played::Film)
    } else {
        None
    }
}

/// Recognises the signatures of containers. Those for both count as a film unless something indicates a sound.
fn by_content(bytes: &[u8], path: &Path) -> Option<Played> {
    let at = |start: usize, mark: &[u8]| bytes.get(start..start + mark.len()) == Some(mark);
    let either = || Some(by_ending(path).unwrap_or(Played::Film));
    if at(0, b"ID3") || at(0, b"fLaC") || at(0, b"MThd") || at(0, b"caff") {
        return Some(Played::Sound);
    }
    // A frame of MPEG audio (ISO 11172-3, 2.4.2.3) or of AAC in ADTS: eleven one bits, and a valid layer.
    if let [0xff, second, third, ..] = bytes
        && matches!(second, 0xe2..=0xe7 | 0xf0..=0xf7 | 0xf8..=0xff)
        && *third != 0xff
    {
        return Some(Played::Sound);
    }
    if at(0, b"OggS") {
        let head = &bytes[..bytes.len().min(4096)];
        let is_film = head.windows(7).any(|w| w == b"\x80theora" || w == b"\x01video\0");
        return Some(if is_film { Played::Film } else { Played::Sound });
    }
    if at(0, b"RIFF") || at(0, b"FORM") {
        return match bytes.get(8..12)? {
            b"WAVE" | b"AIFF" | b"AIFC" => Some(Played::Sound),
            b"AVI " => Some(Played::Film),
            _ => None,
        };
    }
    // ISO 14496-12, 4.3. AVIF and HEIF are pictures in the same container.
    if at(4, b"ftyp") {
        return match bytes.get(8..12)? {
            b"M4A " | b"M4B " | b"M4P " => Some(Played::Sound),
            b"avif" | b"avis" | b"heic" | b"heix" | b"mif1" | b"msf1" => None,
            _ => either(),
        };
    }
    let is_film = at(4, b"moov") || at(4, b"mdat") || at(4, b"wide") || at(0, b"FLV\x01") || at(0, b"\x00\x00\x01\xba");
    // Matroska and WebM; Windows Media.
    if is_film || at(0, b"\x1a\x45\xdf\xa3") || at(0, b"\x30\x26\xb2\x75") {
        return either();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(bytes: &[u8], name: &str) -> Option<Played> {
        Played::of(bytes, Path::new(name))
    }

    #[test]
    fn sounds_and_films_are_recognised_by_content_and_extension() {
        let (sound, film) = (Some(Played::Sound), Some(Played::Film));
        for (bytes, is) in [
            (&b"ID3\x03\0\0\0\0\0\0"[..], sound),
            (b"\xff\xfb\x90\x64", sound),
            (b"\xff\xf1\x50\x80", sound),
            (b"OggS\0\x02\0\0\x01vorbis", sound),
            (b"OggS\0\x02\0\0OpusHead", sound),
            (b"OggS\0\x02\0\0\x80theora", film),
            (b"RIFF\0\0\0\0WAVEfmt ", sound),
            (b"RIFF\0\0\0\0AVI LIST", film),
            (b"fLaC\0\0\0\x22", sound),
            (b"\0\0\0\x20ftypM4A \0\0", sound),
            (b"\0\0\0\x20ftypisom\0\0", film),
            (b"\0\0\0\x14ftypqt  \0\0", film),
            (b"\x1a\x45\xdf\xa3\x9f", film),
        ] {
            assert_eq!(of(bytes, "x.png"), is, "{bytes:?}");
        }
        for (name, is) in [("a.MP3", sound), ("a.opus", sound), ("a.webm", film), ("a.mov", film), ("a.png", None)] {
            assert_eq!(of(b"nothing", name), is, "{name}");
        }
        assert_eq!(of(b"\x1a\x45\xdf\xa3", "a.weba"), sound);
    }

    #[test]
    fn pictures_are_not_recognised_whatever_their_names() {
        for (bytes, name) in [
            (&b"\x89PNG\r\n\x1a\n"[..], "a.mp3"),
            (b"\xff\xd8\xff\xe0", "a.wav"),
            (b"GIF89a", "a.webm"),
            (b"RIFF\0\0\0\0WEBPVP8 ", "a.avi"),
            (b"\0\0\0\x1cftypavif", "a.png"),
            (b"", "a.gif"),
        ] {
            assert_eq!(of(bytes, name), None, "{name}");
        }
    }
}
