//! The file format of a recording: JSON lines, a header followed by a line per frame with its changes.
//!
//! ```text
//! {"eddy_recording":1,"project":"fluid"}
//! {"time":0.0,"delta":0.016666667,"rate":60.0,"size":[640,360],"mouse":[0,0,0,0],"date":[2026,0,1,0]}
//! {"time":0.016,"delta":0.016,"mouse":[320,180,320,180],"held":[32],"pressed":[32],"toggled":[32]}
//! ```
//!
//! `pads` lists the non-zero texels of the gamepads' texture, each as its number, the columns of row 0 first, and its
//! value. `mic` is the texture of the microphone, 1,024 bytes in base64; empty while there is none. An omitted member
//! has the value of the previous line; `frame` increments implicitly, and `reset` is omitted if it is false. Members
//! that a later version of Eddy adds are ignored.

use super::{RecordedFrame, Recording, base64};
use eddy_audio::Spectrum;
use eddy_engine::FrameInputs;
use eddy_media::{Gamepads, Keyboard};
use eddy_project::{
    CustomUniformValue, CustomUniformValues,
    limits::{self, Limit, in_bytes},
};
use serde::{Deserialize, Serialize};
use std::{
    io::{self, BufRead, Write},
    sync::Arc,
};

/// The extension of the files' names.
pub const EXTENSION: &str = eddy_project::RECORDING;
const VERSION: u32 = 1;
/// Bytes of a frame's keys, which frames with the same keys share.
const KEYS: u64 = 3 * Keyboard::WIDTH as u64;
/// Bytes of a frame's gamepads, likewise.
const PADS: u64 = 4 * Gamepads::TEXELS as u64;

#[derive(Serialize, Deserialize)]
struct Head {
    eddy_recording: u32,
    #[serde(default)]
    project: String,
}

/// Floats are written as doubles, which JSON's shortest decimals reproduce bit for bit.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct FileLine {
    #[serde(skip_serializing_if = "Option::is_none")]
    frame: Option<i32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rate: Option<f64>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    reset: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    size: Option<(u32, u32)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mouse: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pointer: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drag: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    date: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    held: Option<Vec<u8>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pressed: Option<Vec<u8>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    toggled: Option<Vec<u8>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pads: Option<Vec<(usize, f64)>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mic: Option<String>,
    /// All values that differ from their defaults.
    #[serde(skip_serializing_if = "Option::is_none")]
    set: Option<serde_json::Map<String, serde_json::Value>>,
}

/// A file that cannot be replayed.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    #[error("{0}")]
    Io(#[from] io::Error),
    #[error("not an Eddy recording: its first line is not {{\"eddy_recording\":{VERSION},…}}")]
    NoRecording,
    #[error("it was recorded by a newer version of Eddy (format {0}; this version reads up to {VERSION})")]
    Later(u32),
    #[error("line {line}: {what}")]
    Line { line: usize, what: String },
    #[error("it has no frames")]
    Empty,
    #[error("it is larger than {0}")]
    TooLarge(Limit),
    #[error(
        "line {line}: with this frame it takes more than {}, the limit for a recording",
        in_bytes(*most)
    )]
    TooMany { line: usize, most: u64 },
}

impl ReadError {
    /// Returns a suggested fix for the user.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Io(_) => "check that the file is there and that you may read it",
            Self::NoRecording => "choose a .replay file that Record input has saved",
            Self::Later(_) => "update Eddy, or record it again with this version",
            Self::Line { .. } => "correct that line, or record the input again",
            Self::Empty => "record the input again",
            Self::TooLarge(_) | Self::TooMany { .. } => "record a shorter run",
        }
    }
}

impl Recording {
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        serde_json::to_writer(&mut *out, &Head { eddy_recording: VERSION, project: self.project.clone() })?;
        out.write_all(b"\n")?;
        let mut before: Option<&RecordedFrame> = None;
        for frame in &self.frames {
            serde_json::to_writer(&mut *out, &FileLine::after(before, frame))?;
            out.write_all(b"\n")?;
            before = Some(frame);
        }
        Ok(())
    }

    /// Reads a whole file. Errors name the line.
    pub fn read(text: impl BufRead) -> Result<Self, ReadError> {
        Self::read_within(text, limits::RECORDING, limits::RECORDING_BYTES)
    }

    /// Reads a file of at most `limit`, into frames of at most `most` bytes in total.
    pub fn read_within(text: impl BufRead, limit: Limit, most: u64) -> Result<Self, ReadError> {
        let mut text = text.take(limit.bytes + 1);
        let read = Self::read_lines(&mut text, most);
        if text.limit() == 0 { Err(ReadError::TooLarge(limit)) } else { read }
    }

    fn read_lines(text: impl BufRead, most: u64) -> Result<Self, ReadError> {
        let mut lines = text.lines();
        let head: Head = match lines.next().transpose()? {
            Some(line) => serde_json::from_str(&line).map_err(|_| ReadError::NoRecording)?,
            None => return Err(ReadError::NoRecording),
        };
        if head.eddy_recording > VERSION {
            return Err(ReadError::Later(head.eddy_recording));
        }
        let mut frames: Vec<RecordedFrame> = Vec::new();
        let mut held = 0;
        for (index, line) in lines.enumerate() {
            let line = line?;
            if line.trim().is_empty() {
                continue;
            }
            let wrong = |what: String| ReadError::Line { line: index + 2, what };
            if line.len() as u64 > limits::RECORDING_LINE.bytes {
                return Err(wrong(format!("it is larger than {}", limits::RECORDING_LINE)));
            }
            let read: FileLine = serde_json::from_str(&line).map_err(|e| wrong(e.to_string()))?;
            let has_keys = [&read.held, &read.pressed, &read.toggled].iter().any(|keys| keys.is_some());
            let (has_spectrum, has_pads) = (read.mic.is_some(), read.pads.is_some());
            let frame = read.onto(frames.last()).map_err(wrong)?;
            // A line contains only changes, but a frame contains everything: few bytes of a file can become very many
            // here.
            let spectrum = if has_spectrum { size_of::<Spectrum>() as u64 } else { 0 };
            held += bytes_of(&frame) + spectrum;
            held += if has_keys { KEYS } else { 0 } + if has_pads { PADS } else { 0 };
            if held > most {
                return Err(ReadError::TooMany { line: index + 2, most });
            }
            frames.push(frame);
        }
        if frames.is_empty() {
            return Err(ReadError::Empty);
        }
        Ok(Self { project: head.project, frames })
    }
}

impl FileLine {
    fn after(before: Option<&RecordedFrame>, now: &RecordedFrame) -> Self {
        fn new<T: PartialEq>(before: Option<T>, now: T) -> Option<T> {
            (before.as_ref() != Some(&now)).then_some(now)
        }
        let (inputs, earlier) = (&now.inputs, before.map(|before| &before.inputs));
        let row = |keyboard: &Keyboard, row: usize| -> Vec<u8> {
            let bytes = &keyboard.bytes()[row * Keyboard::WIDTH..][..Keyboard::WIDTH];
            (0..=u8::MAX).filter(|code| bytes[usize::from(*code)] != 0).collect()
        };
        // Compare bits: -0 differs from 0 for a shader that tests the sign.
        let mouse = |inputs: &FrameInputs| inputs.mouse.map(f32::to_bits);
        let keys = |n: usize| {
            // No key is pressed before the first frame.
            let before = earlier.map_or_else(Vec::new, |earlier| row(&earlier.keyboard, n));
            new(Some(before), row(&inputs.keyboard, n))
        };
        let pads = |inputs: &FrameInputs| -> Vec<(usize, f64)> {
            let texels = inputs.gamepads.texels().iter().enumerate();
            texels.filter(|(_, value)| **value != 0.0).map(|(index, value)| (index, f64::from(*value))).collect()
        };
        let expected = earlier.map_or(0, |earlier| earlier.frame.saturating_add(1));
        let values = |frame: &RecordedFrame| frame.values.clone();
        Self {
            frame: (inputs.frame != expected).then_some(inputs.frame),
            time: Some(inputs.time_secs),
            delta: new(earlier.map(|i| i.time_delta_secs), inputs.time_delta_secs).map(f64::from),
            rate: new(earlier.map(|i| i.frame_rate), inputs.frame_rate).map(f64::from),
            reset: now.reset,
            size: new(before.map(|before| before.size), now.size),
            mouse: new(earlier.map(mouse), mouse(inputs)).map(|bits| bits.map(|bits| f32::from_bits(bits).into())),
            // A pointer does not return to where it has never been.
            pointer: inputs
                .pointer
                .filter(|_| earlier.map(|i| i.pointer) != Some(inputs.pointer))
                .map(|p| p.map(f64::from)),
            drag: new(earlier.map(|i| i.drag), inputs.drag).map(|drag| drag.map(f64::from)),
            date: new(earlier.map(|i| i.date), inputs.date).map(|date| date.map(f64::from)),
            held: keys(0),
            pressed: keys(1),
            toggled: keys(2),
            pads: new(Some(earlier.map_or_else(Vec::new, pads)), pads(inputs)),
            mic: new(Some(earlier.and_then(|i| i.microphone.as_ref())), inputs.microphone.as_ref())
                .map(|spectrum| spectrum.map_or_else(String::new, |spectrum| base64::encode(&**spectrum))),
            set: new(before.map(values).or_else(|| Some(CustomUniformValues::new())), values(now))
                .map(|values| values.into_iter().map(|(name, value)| (name, written(&value))).collect()),
        }
    }

    fn onto(self, before: Option<&RecordedFrame>) -> Result<RecordedFrame, String> {
        let mut frame = before.cloned().unwrap_or_else(|| RecordedFrame {
            inputs: FrameInputs::at_fixed_step(-1, 60.0),
            size: (0, 0),
            values: CustomUniformValues::new(),
            reset: false,
        });
        let inputs = &mut frame.inputs;
        inputs.frame = self.frame.unwrap_or(inputs.frame.saturating_add(1));
        let time = self.time.or_else(|| before.map(|before| before.inputs.time_secs));
        inputs.time_secs = time.ok_or("the first frame has no `time`")?;
        let single = |x: f64| x as f32;
        inputs.time_delta_secs = self.delta.map_or(inputs.time_delta_secs, single);
        inputs.frame_rate = self.rate.map_or(inputs.frame_rate, single);
        inputs.mouse = self.mouse.map_or(inputs.mouse, |mouse| mouse.map(single));
        inputs.pointer = self.pointer.map(|pointer| pointer.map(single)).or(inputs.pointer);
        inputs.drag = self.drag.map_or(inputs.drag, |drag| drag.map(single));
        inputs.date = self.date.map_or(inputs.date, |date| date.map(single));
        for (row, codes) in [self.held, self.pressed, self.toggled].into_iter().enumerate() {
            if let Some(codes) = codes {
                inputs.keyboard.set_row(row, &codes);
            }
        }
        if let Some(texels) = self.pads {
            inputs.gamepads = Gamepads::default();
            texels.into_iter().for_each(|(index, value)| inputs.gamepads.set(index, single(value)));
        }
        if let Some(text) = self.mic {
            inputs.microphone = spectrum(&text)?;
        }
        frame.reset = self.reset;
        frame.size = self.size.or(before.map(|before| before.size)).ok_or("the first frame has no `size`")?;
        if frame.size.0 == 0 || frame.size.1 == 0 {
            return Err("a `size` must be at least 1".into());
        }
        if let Some(set) = self.set {
            let read = |(name, value)| {
                let value = read_value(&value).ok_or_else(|| format!("`{name}` has a value of an unknown type"))?;
                Ok((name, value))
            };
            frame.values = set.into_iter().map(read).collect::<Result<_, String>>()?;
        }
        Ok(frame)
    }
}

/// Decodes the content of the microphone's texture.
fn spectrum(text: &str) -> Result<Option<Arc<Spectrum>>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let bytes = base64::decode(text).and_then(|bytes| Spectrum::try_from(bytes).ok());
    let bytes = bytes.ok_or_else(|| format!("`mic` must be {} bytes in base64", size_of::<Spectrum>()))?;
    Ok(Some(Arc::new(bytes)))
}

/// Returns the approximate size of a frame in bytes.
fn bytes_of(frame: &RecordedFrame) -> u64 {
    fn of(value: &CustomUniformValue) -> usize {
        let within = match value {
            CustomUniformValue::Vector(all) => size_of_val(all.as_slice()),
            CustomUniformValue::List(all) => all.iter().map(of).sum(),
            _ => 0,
        };
        size_of::<CustomUniformValue>() + within
    }
    let values = frame.values.iter().map(|(name, value)| size_of::<String>() + name.len() + of(value));
    (size_of::<RecordedFrame>() + values.sum::<usize>()) as u64
}

fn written(value: &CustomUniformValue) -> serde_json::Value {
    match value {
        CustomUniformValue::Bool(on) => (*on).into(),
        CustomUniformValue::Int(n) => (*n).into(),
        CustomUniformValue::Float(x) => (*x).into(),
        CustomUniformValue::Vector(all) => all.clone().into(),
        CustomUniformValue::List(all) => all.iter().map(written).collect(),
    }
}

fn read_value(value: &serde_json::Value) -> Option<CustomUniformValue> {
    use serde_json::Value;
    Some(match value {
        Value::Bool(on) => CustomUniformValue::Bool(*on),
        Value::Number(n) if n.is_f64() => CustomUniformValue::Float(n.as_f64()?),
        Value::Number(n) => CustomUniformValue::Int(i32::try_from(n.as_i64()?).ok()?),
        Value::Array(all) if (2..=4).contains(&all.len()) && all.iter().all(Value::is_f64) => {
            CustomUniformValue::Vector(all.iter().filter_map(Value::as_f64).collect())
        }
        Value::Array(all) => CustomUniformValue::List(all.iter().map(read_value).collect::<Option<_>>()?),
        _ => return None,
    })
}
