//! The options of file formats, with their names on the command line.

use super::formats::{FormatKind, ROWS};

/// The format of a file. What is known of each is in the table of `formats.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Png,
    Exr,
    Npy,
    Gif,
    Apng,
    Webm,
    Mp4,
    Mov,
    Mkv,
    Y4m,
    Raw,
}

impl Format {
    /// All formats: films, then pictures.
    pub const ALL: [Format; ROWS.len()] = {
        let mut all = [Format::Png; ROWS.len()];
        let mut index = 0;
        while index < ROWS.len() {
            all[index] = ROWS[index].format;
            index += 1;
        }
        all
    };

    /// Returns its name, which is also the file extension.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Returns its name in a list of choices.
    pub fn title(self) -> &'static str {
        self.row().title
    }

    /// Returns the maximum frames per second of the format, where it is lower than a film may request.
    pub fn max_fps(self) -> Option<f64> {
        self.row().max_fps
    }

    /// Returns all formats with pictures first, as the command line lists them: it draws pictures unless told otherwise.
    pub fn pictures_first() -> [Format; ROWS.len()] {
        let mut all = Format::ALL;
        all.sort_by_key(|format| !format.is_still());
        all
    }

    /// Returns the format with this name, ignoring case.
    pub fn of_name(name: &str) -> Option<Format> {
        Format::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// Returns whether a file contains one picture.
    pub fn is_still(self) -> bool {
        matches!(self.row().kind, FormatKind::Still(_))
    }

    /// Returns the codecs that a film of the format may have, the default first; none if it has no choice.
    pub fn codecs(self) -> &'static [Codec] {
        self.container().map_or(&[], |container| container.codecs)
    }

    /// Returns whether a file may contain sound.
    pub fn has_sound(self) -> bool {
        self.container().is_some()
    }

    /// Returns whether the format can be written to a pipe, where no byte is written twice.
    pub fn is_sequential(self) -> bool {
        self.row().is_sequential
    }
}

/// The codec of a film's pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Codec {
    H264,
    H265,
    Vp9,
    Av1,
    ProRes,
    Ffv1,
}

impl Codec {
    pub const ALL: [Codec; 6] = [Codec::H264, Codec::H265, Codec::Vp9, Codec::Av1, Codec::ProRes, Codec::Ffv1];

    /// Returns its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Codec::H264 => "h264",
            Codec::H265 => "h265",
            Codec::Vp9 => "vp9",
            Codec::Av1 => "av1",
            Codec::ProRes => "prores",
            Codec::Ffv1 => "ffv1",
        }
    }

    /// Returns its name in a sentence.
    pub fn title(self) -> &'static str {
        match self {
            Codec::H264 => "H.264",
            Codec::H265 => "H.265",
            Codec::Vp9 => "VP9",
            Codec::Av1 => "AV1",
            Codec::ProRes => "ProRes",
            Codec::Ffv1 => "FFV1",
        }
    }

    pub fn of_name(name: &str) -> Option<Codec> {
        Codec::ALL.into_iter().find(|codec| codec.name().eq_ignore_ascii_case(name))
    }
}

/// The trade-off between file size and fidelity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    Low,
    Medium,
    High,
    /// Every pixel has the bytes that an 8-bit PNG has.
    Lossless,
    /// The encoder's own number: the constant rate factor, or the quantiser of ProRes.
    Number(u32),
}

impl Quality {
    pub fn parse(text: &str) -> Option<Quality> {
        Some(match text {
            "low" => Quality::Low,
            "medium" => Quality::Medium,
            "high" => Quality::High,
            "lossless" => Quality::Lossless,
            number => Quality::Number(number.parse().ok()?),
        })
    }
}

/// The resolution of the chroma planes relative to luma.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chroma {
    /// Half across and down, which every player supports.
    C420,
    /// Half across.
    C422,
    C444,
}

impl Chroma {
    pub fn parse(text: &str) -> Option<Chroma> {
        Some(match text {
            "420" => Chroma::C420,
            "422" => Chroma::C422,
            "444" => Chroma::C444,
            _ => return None,
        })
    }

    /// Returns its name in a sentence.
    pub fn title(self) -> &'static str {
        match self {
            Chroma::C420 => "4:2:0",
            Chroma::C422 => "4:2:2",
            Chroma::C444 => "4:4:4",
        }
    }
}

/// The codes of black and white.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorRange {
    /// 16 and 235 of 8 bits (ITU-R BT.709-6, section 4.6).
    Limited,
    /// 0 and 255.
    Full,
}

impl ColorRange {
    pub fn parse(text: &str) -> Option<ColorRange> {
        Some(match text {
            "limited" => ColorRange::Limited,
            "full" => ColorRange::Full,
            _ => return None,
        })
    }
}
