//! The user's choices for a film, and their validation.
//!
//! Fields are texts, so that partial input stays as it is. They are stored as options of `eddy render`, which express
//! the same.

use super::{FilmOrder, FilmPlace};
use eddy_film::{
    Codec, Encoding, Fade, FilmEncoding, FilmError, Format, Quality, Rate, Style, check_encoders, check_size,
};
use eddy_playback::frames::{FrameList, film_step};
use std::{fmt::Write as _, fs, path::PathBuf};

/// The choices for a film.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmForm {
    /// The frames of a film that is drawn offline: `0-599`, `0-599:2`, `600` or `2.5s-10s`.
    pub range: String,
    /// `1920x1080`; empty: the size in the window.
    pub size: String,
    /// Frames per second.
    pub fps: String,
    pub format: Format,
    /// `None`: the format's default.
    pub codec: Option<Codec>,
    /// `low`, `medium`, `high`, `lossless` or a number; empty: the codec's default.
    pub quality: String,
    /// Seconds of the start that are cross-faded with the frames after the end; empty: no loop.
    pub fade: String,
    pub with_sound: bool,
    /// A file name or path; empty: the next free number. It is not stored.
    pub file: String,
}

impl Default for FilmForm {
    fn default() -> Self {
        Self {
            range: "10s".into(),
            size: String::new(),
            fps: "60".into(),
            format: Format::Mp4,
            codec: None,
            quality: String::new(),
            fade: String::new(),
            with_sound: true,
            file: String::new(),
        }
    }
}

/// A preset of several fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmPreset {
    Uhd,
    SquareLoop,
    WebGif,
}

impl FilmPreset {
    pub const ALL: [FilmPreset; 3] = [FilmPreset::Uhd, FilmPreset::SquareLoop, FilmPreset::WebGif];

    pub fn title(self) -> &'static str {
        match self {
            FilmPreset::Uhd => "4K film",
            FilmPreset::SquareLoop => "Square loop",
            FilmPreset::WebGif => "GIF for a page",
        }
    }

    /// Returns a description in one sentence.
    pub fn about(self) -> &'static str {
        match self {
            FilmPreset::Uhd => "3840x2160 pixels, 60 frames per second, H.264 in high quality",
            FilmPreset::SquareLoop => "1080x1080 pixels, 6 s at 30 frames per second, the end faded into the start",
            FilmPreset::WebGif => "480x270 pixels, 4 s at 20 frames per second",
        }
    }

    /// Returns the fields with this preset. Sound and the file name stay.
    pub fn apply(self, form: &FilmForm) -> FilmForm {
        let base = FilmForm { with_sound: form.with_sound, file: form.file.clone(), ..FilmForm::default() };
        match self {
            FilmPreset::Uhd => {
                FilmForm { range: form.range.clone(), size: "3840x2160".into(), quality: "high".into(), ..base }
            }
            FilmPreset::SquareLoop => {
                FilmForm { range: "6s".into(), size: "1080x1080".into(), fps: "30".into(), fade: "1".into(), ..base }
            }
            FilmPreset::WebGif => {
                FilmForm { range: "4s".into(), size: "480x270".into(), fps: "20".into(), format: Format::Gif, ..base }
            }
        }
    }
}

/// A field of a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FilmField {
    Range,
    Size,
    Rate,
    Format,
    Codec,
    Quality,
    Fade,
    File,
}

impl FilmField {
    /// Returns whether the field applies only to films of a range.
    fn is_of_range(self) -> bool {
        matches!(self, FilmField::Range | FilmField::Fade)
    }
}

/// The facts that a form is validated against.
#[derive(Clone, Debug, Default)]
pub struct FilmFacts {
    /// The size of the window's picture in pixels.
    pub shown: (u32, u32),
    /// The largest side in pixels.
    pub most_side: u32,
    /// The folder for file names without one.
    pub folder: PathBuf,
    /// Seconds after which the picture repeats.
    pub period: Option<f64>,
    /// The encoders of ffmpeg, or why there are none; `None`: not known yet.
    pub encoders: Option<Result<Vec<String>, String>>,
}

/// A validated form.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckedForm {
    /// The errors, each with its field.
    pub errors: Vec<(FilmField, String)>,
    /// A film of the range; `None` if a field has an error.
    pub range: Option<FilmOrder>,
    /// A film of the frames that the window draws.
    pub live: Option<FilmOrder>,
    /// The reason why there is no such film, if it does not concern a single field.
    pub not_live: Option<String>,
    /// The file exists, and may be replaced if the user agrees.
    pub is_taken: bool,
}

impl CheckedForm {
    pub fn error(&self, field: FilmField) -> Option<&str> {
        self.errors.iter().find(|(of, _)| *of == field).map(|(_, why)| why.as_str())
    }
}

impl FilmForm {
    /// Validates the fields. `replaces`: the user has allowed replacing an existing file.
    pub fn check(&self, facts: &FilmFacts, replaces: bool) -> CheckedForm {
        let mut checked = CheckedForm::default();
        let errors = &mut checked.errors;
        let mut keep = |field: FilmField, result: Result<(), String>| {
            if let Err(why) = result {
                errors.push((field, why));
            }
        };
        let fps = read_fps(&self.fps);
        let frames = match fps {
            Ok(fps) => FrameList::of_film(&self.range, fps).map(|list| list.numbers()),
            // The rate is reported at its own field.
            Err(_) => Ok(Vec::new()),
        };
        let step = frames.as_ref().map_or(Ok(1), |frames| match self.format.is_still() {
            true => Ok(1),
            false => film_step(frames),
        });
        let quality = match self.quality.trim() {
            "" => Ok(None),
            text => {
                Quality::parse(text).map(Some).ok_or_else(|| "write low, medium, high, lossless or a number".to_owned())
            }
        };
        let quality_given = quality.clone().ok().flatten();
        let style = |codec, quality| Style { codec, quality, ..Style::new(self.format) };
        let encoding = style(self.codec, quality_given).resolve();
        let size = read_size(&self.size, facts).map(|size| match &encoding {
            Ok(encoding) if self.size.trim().is_empty() => fitting(encoding, size),
            _ => size,
        });
        // The first choice that is wrong by itself is reported.
        let field = match (style(self.codec, None).resolve(), quality_given) {
            (Err(_), _) if self.codec.is_some() => FilmField::Codec,
            (Ok(_), Some(_)) => FilmField::Quality,
            _ => FilmField::Format,
        };
        let rate = |step: u32| -> Result<Rate, String> {
            let per_second = fps.clone().unwrap_or(60.0) / f64::from(step);
            let rate = Rate::of(per_second).ok_or_else(|| FilmError::Rate(per_second).to_string())?;
            match &encoding {
                Ok(Encoding::Film(film)) => film.check_rate(rate).map(|()| rate).map_err(|error| error.to_string()),
                _ => Ok(rate),
            }
        };
        let (whole, stepped) = (rate(1), rate(step.clone().unwrap_or(1)));
        let fade = match self.fade.trim() {
            "" => Ok(None),
            _ if self.format.is_still() => Err("a loop is for films, and this format holds single pictures".to_owned()),
            text => match text.trim_end_matches('s').trim().parse::<f64>() {
                Ok(secs) if secs.is_finite() && secs >= 0.0 => Ok(Some(secs)),
                _ => Err("write seconds, as in 1 or 0.5".to_owned()),
            },
        };
        let too_long = match (&fade, &frames, &stepped) {
            (Ok(Some(secs)), Ok(frames), Ok(rate)) if fps.is_ok() => {
                Fade::new(*secs, facts.period, *rate, frames.len() as u32).map(drop)
            }
            _ => Ok(()),
        };
        keep(FilmField::Range, frames.clone().map(drop).and(step.map(drop)));
        keep(FilmField::Size, size.clone().map(drop));
        keep(FilmField::Rate, fps.clone().map(drop).and(stepped.clone().map(drop)));
        keep(FilmField::Quality, quality.map(drop));
        keep(field, encoding.clone().map(drop));
        keep(FilmField::Fade, fade.clone().map(drop).and(too_long));
        if let Ok(encoding) = &encoding {
            // A missing feature of ffmpeg is reported whatever the size is.
            let at = size.clone().unwrap_or(facts.shown);
            if size.is_ok() {
                keep(FilmField::Size, check_size(encoding, at).map_err(|error| error.to_string()));
            }
            let needs_ffmpeg = matches!(encoding, Encoding::Film(film) if film.needs_ffmpeg());
            match &facts.encoders {
                Some(Err(why)) if needs_ffmpeg => keep(FilmField::Format, Err(why.clone())),
                Some(Ok(there)) if needs_ffmpeg => {
                    let field = if self.codec.is_some() { FilmField::Codec } else { FilmField::Format };
                    keep(field, check_encoders(encoding, at, there).map_err(|error| error.to_string()));
                }
                _ => {}
            }
        }
        let (place, is_taken) = self.place(facts, replaces);
        keep(FilmField::File, place.clone().map(drop));
        checked.is_taken = is_taken;
        let blocks =
            |errors: &[(FilmField, String)], live: bool| errors.iter().any(|(field, _)| !(live && field.is_of_range()));
        let (Ok(size), Ok(fps), Ok(encoding), Ok(place)) = (size, fps, encoding, place) else { return checked };
        let order = |frames, rate, fade_secs| FilmOrder {
            frames,
            size,
            fps,
            rate,
            format: self.format,
            encoding: encoding.clone(),
            with_sound: self.with_sound,
            fade_secs,
            place: place.clone(),
        };
        if let (Ok(frames), Ok(rate), Ok(fade), false) = (frames, stepped, fade, blocks(&checked.errors, false)) {
            checked.range = Some(order(Some(frames), rate, fade));
        }
        // With the step of a range, the rate may be one that the format supports.
        match (whole, encoding.clone()) {
            (Err(why), _) => checked.not_live = Some(why),
            (_, Encoding::Film(FilmEncoding::Apng(_))) => {
                checked.not_live = Some(FilmError::NoLength { format: "apng" }.to_string());
            }
            (Ok(rate), _) if !blocks(&checked.errors, true) => checked.live = Some(order(None, rate, None)),
            _ => {}
        }
        checked
    }

    /// Returns the place of the film, and whether a file exists there.
    fn place(&self, facts: &FilmFacts, replaces: bool) -> (Result<FilmPlace, String>, bool) {
        let typed = self.file.trim();
        if typed.is_empty() {
            return (Ok(FilmPlace::Numbered), false);
        }
        let mut path = facts.folder.join(typed);
        if !self.format.is_still() {
            let ending = path.extension().map(|ending| ending.to_string_lossy().into_owned());
            match ending.as_deref().map(Format::of_name) {
                Some(Some(format)) if format == self.format => {}
                // An animated PNG often has the extension of a PNG.
                Some(Some(Format::Png)) if self.format == Format::Apng => {}
                Some(Some(other)) => {
                    let (other, name) = (other.name(), self.format.name());
                    return (Err(format!("the name ends in .{other}, but the format is {name}")), false);
                }
                _ => path.as_mut_os_string().push(format!(".{}", self.format.name())),
            }
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_taken = match fs::symlink_metadata(&path) {
            Err(_) => false,
            Ok(there) if there.is_dir() && !self.format.is_still() => {
                return (Err(format!("{name} is a folder; give the name of a file")), false);
            }
            Ok(there) if there.is_dir() => fs::read_dir(&path).is_ok_and(|mut files| files.next().is_some()),
            Ok(_) if self.format.is_still() => {
                return (Err(format!("{name} is a file; pictures go into a folder")), false);
            }
            Ok(_) => true,
        };
        if is_taken && !replaces {
            let what = if self.format.is_still() { "has files already" } else { "already exists" };
            return (Err(format!("{name} {what}; choose another name, or replace it")), true);
        }
        (Ok(FilmPlace::Named { path, replaces }), is_taken)
    }

    /// Formats the choices as options of `eddy render`, without the file.
    pub fn options(&self) -> String {
        let mut text = String::new();
        let mut add = |option: &str, value: &str| {
            let value: String = value.split_whitespace().collect();
            if !value.is_empty() {
                // Writing to a string does not fail.
                let _ = write!(text, "{}--{option} {value}", if text.is_empty() { "" } else { " " });
            }
        };
        add("frames", &self.range);
        add("size", &self.size);
        add("fps", &self.fps);
        add("format", self.format.name());
        add("codec", self.codec.map_or("", Codec::name));
        add("quality", &self.quality);
        add("loop", &self.fade);
        if !self.with_sound {
            text.push_str(" --no-audio");
        }
        text
    }

    /// Parses such options; omitted ones keep their defaults. Returns an error that states the valid values.
    pub fn of_options(text: &str) -> Result<FilmForm, String> {
        let mut form = FilmForm { size: String::new(), ..FilmForm::default() };
        let mut words = text.split_whitespace();
        let mut has_rate = false;
        while let Some(option) = words.next() {
            if option == "--no-audio" {
                form.with_sound = false;
                continue;
            }
            let mut value =
                || words.next().ok_or_else(|| format!("must have a value after {option}")).map(str::to_owned);
            match option {
                "--frames" => form.range = value()?,
                "--size" => form.size = value()?,
                "--fps" => (form.fps, has_rate) = (value()?, true),
                "--format" => {
                    let name = value()?;
                    form.format = Format::of_name(&name).ok_or_else(|| format!("has an unknown format, {name}"))?;
                }
                "--codec" => {
                    let name = value()?;
                    form.codec = Some(Codec::of_name(&name).ok_or_else(|| format!("has an unknown codec, {name}"))?);
                }
                "--quality" => form.quality = value()?,
                "--loop" => form.fade = value()?,
                _ => {
                    return Err(format!(
                        "must be options of eddy render, as in \"--frames 10s --format mp4\"; {option} is none"
                    ));
                }
            }
        }
        if let Some(fastest) = form.format.max_fps().filter(|_| !has_rate) {
            form.fps = fastest.to_string();
        }
        Ok(form)
    }
}

fn read_size(text: &str, facts: &FilmFacts) -> Result<(u32, u32), String> {
    let text = text.trim();
    if text.is_empty() {
        return Ok(facts.shown);
    }
    let numbers: Option<Vec<u32>> = text.split(['x', 'X', '×']).map(|side| side.trim().parse().ok()).collect();
    let most = facts.most_side;
    match numbers.as_deref() {
        Some([0, _] | [_, 0]) => Err("width and height are at least 1".into()),
        Some(&[width, height]) if width > most || height > most => Err(format!("this GPU draws at most {most}x{most}")),
        Some(&[width, height]) => Ok((width, height)),
        _ => Err("write width and height, as in 1920x1080".into()),
    }
}

/// Returns the size of the window's picture, reduced by a pixel if the encoding requires even sides.
fn fitting(encoding: &Encoding, size: (u32, u32)) -> (u32, u32) {
    let even = |side: u32| (side & !1).max(2);
    if check_size(encoding, size).is_ok() { size } else { (even(size.0), even(size.1)) }
}

fn read_fps(text: &str) -> Result<f64, String> {
    let fps = Rate::parse(text).ok_or("write frames per second, as in 60, 29.97 or 24000/1001")?;
    Rate::of(fps).map(|_| fps).ok_or_else(|| FilmError::Rate(fps).to_string())
}

#[cfg(test)]
mod tests;
