//! The table of file formats: a row has everything that is known of one.

use super::{
    still::Still,
    style::FilmEncoding,
    values::{Codec, Format},
};

/// A row of the table.
pub(super) struct FormatRow {
    pub format: Format,
    /// The extension of its files, and its name on a command line.
    pub name: &'static str,
    /// Its name in a list of choices.
    pub title: &'static str,
    pub kind: FormatKind,
    /// Bits of a component, the default first. Empty where there is no choice.
    pub depths: &'static [u32],
    /// The highest rate in frames per second, if it is lower than what people ask for.
    pub max_fps: Option<f64>,
    /// It is written from the first byte to the last, so that a pipe will do.
    pub is_sequential: bool,
}

/// The content of a file.
pub(super) enum FormatKind {
    /// One picture, by the bits of a component.
    Still(fn(u32) -> Still),
    /// All frames of a run, by the bits of a component.
    Film(fn(u32) -> FilmEncoding),
    /// The same, with a choice of chroma format and range.
    YuvFilm,
    /// Frames that ffmpeg compresses, and sound.
    Container(Container),
}

/// A container that ffmpeg writes.
pub(super) struct Container {
    /// ffmpeg's name.
    pub muxer: &'static str,
    /// The codecs it may contain, the default first.
    pub codecs: &'static [Codec],
    /// ffmpeg's options for the codec of its sound.
    pub sound: &'static [&'static str],
    /// It is of the ISO base media file format (ISO/IEC 14496-12), which has the options of ffmpeg's `mov` muxer.
    pub is_iso_media: bool,
}

impl Format {
    pub(super) fn row(self) -> &'static FormatRow {
        ROWS.iter().find(|row| row.format == self).expect("every format has a row")
    }

    pub(super) fn container(self) -> Option<&'static Container> {
        match &self.row().kind {
            FormatKind::Container(container) => Some(container),
            _ => None,
        }
    }
}

const FLAC: &[&str] = &["-c:a", "flac"];

/// Films are before pictures, and the most common ones first: lists show them in this order.
pub(super) const ROWS: [FormatRow; 11] = [
    container(
        Format::Mp4,
        "mp4",
        "MP4",
        Container {
            muxer: "mp4",
            codecs: &[Codec::H264, Codec::H265, Codec::Av1, Codec::Vp9],
            sound: &["-c:a", "aac", "-b:a", "256k"],
            is_iso_media: true,
        },
    ),
    container(
        Format::Webm,
        "webm",
        "WebM",
        Container {
            muxer: "webm",
            codecs: &[Codec::Vp9, Codec::Av1],
            sound: &["-c:a", "libopus", "-b:a", "192k"],
            is_iso_media: false,
        },
    ),
    container(
        Format::Mov,
        "mov",
        "MOV (QuickTime)",
        Container {
            muxer: "mov",
            codecs: &[Codec::ProRes, Codec::H264, Codec::H265, Codec::Ffv1],
            sound: &["-c:a", "pcm_s16le"],
            is_iso_media: true,
        },
    ),
    container(
        Format::Mkv,
        "mkv",
        "MKV (Matroska)",
        Container {
            muxer: "matroska",
            codecs: &[Codec::Ffv1, Codec::H264, Codec::H265, Codec::Av1, Codec::Vp9, Codec::ProRes],
            sound: FLAC,
            is_iso_media: false,
        },
    ),
    FormatRow {
        format: Format::Gif,
        name: "gif",
        title: "GIF",
        kind: FormatKind::Film(|_| FilmEncoding::Gif),
        depths: &[],
        // Browsers show no frame for less than two hundredths of a second.
        max_fps: Some(50.0),
        is_sequential: false,
    },
    sequential(Format::Apng, "apng", "Animated PNG", FormatKind::Film(FilmEncoding::Apng), &[8, 16]),
    sequential(Format::Y4m, "y4m", "Y4M, uncompressed", FormatKind::YuvFilm, &[8, 10]),
    sequential(Format::Raw, "raw", "Raw RGBA, uncompressed", FormatKind::Film(FilmEncoding::Raw), &[8, 16]),
    sequential(Format::Png, "png", "PNG sequence", FormatKind::Still(|depth| Still::Png { depth }), &[8, 16]),
    sequential(Format::Exr, "exr", "EXR sequence, floats", FormatKind::Still(|_| Still::Exr), &[]),
    sequential(Format::Npy, "npy", "NPY sequence, floats", FormatKind::Still(|_| Still::Npy), &[]),
];

/// Returns the row of a container. The depths are those of the codec.
const fn container(format: Format, name: &'static str, title: &'static str, container: Container) -> FormatRow {
    let kind = FormatKind::Container(container);
    FormatRow { format, name, title, kind, depths: &[], max_fps: None, is_sequential: false }
}

const fn sequential(
    format: Format,
    name: &'static str,
    title: &'static str,
    kind: FormatKind,
    depths: &'static [u32],
) -> FormatRow {
    FormatRow { format, name, title, kind, depths, max_fps: None, is_sequential: true }
}
