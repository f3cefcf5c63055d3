//! The options of file formats, with their names on the command line.

/// The format of a file.
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
    pub const ALL: [Format; 11] = [
        Format::Png,
        Format::Exr,
        Format::Npy,
        Format::Gif,
        Format::Apng,
        Format::Webm,
        Format::Mp4,
        Format::Mov,
        Format::Mkv,
        Format::Y4m,
        Format::Raw,
    ];

    /// Returns its name, which is also the file extension.
    pub fn name(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Exr => "exr",
            Format::Npy => "npy",
            Format::Gif => "gif",
            Format::Apng => "apng",
            Format::Webm => "webm",
            Format::Mp4 => "mp4",
            Format::Mov => "mov",
            Format::Mkv => "mkv",
            Format::Y4m => "y4m",
            Format::Raw => "raw",
        }
    }

    /// Returns the maximum frames per second of the format, where it is lower than a film may request. Browsers show
    /// each frame of a GIF for at least two hundredths of a second.
    pub fn fastest(self) -> Option<f64> {
        (self == Format::Gif).then_some(50.0)
    }

    /// Returns the format with this name, ignoring case.
    pub fn of_name(name: &str) -> Option<Format> {
        Format::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// Returns whether a file contains one picture.
    pub fn is_still(self) -> bool {
        matches!(self, Format::Png | Format::Exr | Format::Npy)
    }

    /// Returns whether a file may contain sound.
    pub fn holds_sound(self) -> bool {
        matches!(self, Format::Webm | Format::Mp4 | Format::Mov | Format::Mkv)
    }

    /// Returns whether the format can be written to a pipe, that is, without seeking.
    pub fn is_for_pipes(self) -> bool {
        self.is_still() || matches!(self, Format::Y4m | Format::Raw | Format::Apng)
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
