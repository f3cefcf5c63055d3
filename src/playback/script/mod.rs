//! Scripted input: `--mouse`, `--keys`, and the resulting [`FrameInputs`] at a fixed step.
//!
//! Events of frame i happen before frame i is drawn, so a script produces the same pictures on every machine. A
//! [`Recording`] replaces both.

use crate::{
    date,
    mouse::Mouse,
    recording::{Change, Recording},
};
use eddy_engine::FrameInputs;
use eddy_media::Keyboard;
use jiff::{SignedDuration, civil::DateTime};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An action of the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MouseAction {
    /// Canvas pixels from the bottom left.
    Down(f32, f32),
    Move(f32, f32),
    Up,
}

/// An action of a key, by JavaScript `keyCode`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyAction {
    Down(u8),
    Up(u8),
}

/// An action before a frame is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScriptedAction<A> {
    pub frame: i32,
    pub action: A,
}

/// The syntax error of a script: its position and what was expected there.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at character {position}: expected {expected}, found {found}")]
pub struct ScriptError {
    /// The position of the character in the script, counted from 1.
    pub position: usize,
    pub expected: String,
    pub found: String,
}

/// Parses `0:down 40,40; 4:move 80,45; 10:up`. Returns the events in the order of their frames, those of one frame as
/// written.
pub fn parse_mouse(text: &str) -> Result<Vec<ScriptedAction<MouseAction>>, ScriptError> {
    parse(
        text,
        |word, r| match word {
            "down" => r.point().map(|(x, y)| Some(MouseAction::Down(x, y))),
            "move" => r.point().map(|(x, y)| Some(MouseAction::Move(x, y))),
            "up" => Ok(Some(MouseAction::Up)),
            _ => Ok(None),
        },
        "`down X,Y`, `move X,Y` or `up`",
    )
}

/// Parses `0:down 32; 3:up 32`, in the same order.
pub fn parse_keys(text: &str) -> Result<Vec<ScriptedAction<KeyAction>>, ScriptError> {
    parse(
        text,
        |word, r| match word {
            "down" => r.key().map(|k| Some(KeyAction::Down(k))),
            "up" => r.key().map(|k| Some(KeyAction::Up(k))),
            _ => Ok(None),
        },
        "`down CODE` or `up CODE`",
    )
}

fn parse<A>(
    text: &str,
    action: impl Fn(&str, &mut Reader<'_>) -> Result<Option<A>, ScriptError>,
    actions: &str,
) -> Result<Vec<ScriptedAction<A>>, ScriptError> {
    let mut r = Reader { text, at: 0 };
    let mut events = Vec::new();
    loop {
        r.skip_space();
        if r.rest().is_empty() {
            break;
        }
        if r.take(';') {
            continue;
        }
        let frame = r.number::<u32>("a frame number from 0 on").and_then(|(start, n)| {
            i32::try_from(n).map_err(|_| r.error_at(start, "a frame number below 2147483648"))
        })?;
        r.want(':')?;
        r.skip_space();
        let start = r.at;
        let word = r.word();
        let Some(action) = action(word, &mut r)? else { return Err(r.error_at(start, actions)) };
        events.push(ScriptedAction { frame, action });
        r.skip_space();
        if !r.rest().is_empty() && !r.take(';') {
            return Err(r.error("`;` or the end"));
        }
    }
    events.sort_by_key(|e| e.frame);
    Ok(events)
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip_space(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    fn take(&mut self, c: char) -> bool {
        let found = self.rest().starts_with(c);
        self.at += if found { c.len_utf8() } else { 0 };
        found
    }

    fn want(&mut self, c: char) -> Result<(), ScriptError> {
        self.skip_space();
        if self.take(c) { Ok(()) } else { Err(self.error(format!("`{c}`"))) }
    }

    fn word(&mut self) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    fn number<N: std::str::FromStr>(&mut self, expected: &str) -> Result<(usize, N), ScriptError> {
        self.skip_space();
        let (start, rest) = (self.at, self.rest());
        let end = rest.find(|c: char| !(c.is_ascii_digit() || matches!(c, '-' | '+' | '.'))).unwrap_or(rest.len());
        let value = rest[..end].parse().map_err(|_| self.error_at(start, expected))?;
        self.at += end;
        Ok((start, value))
    }

    fn point(&mut self) -> Result<(f32, f32), ScriptError> {
        let (_, x) = self.number("x in pixels of the picture")?;
        self.want(',')?;
        let (_, y) = self.number("y in pixels of the picture, from the bottom")?;
        Ok((x, y))
    }

    fn key(&mut self) -> Result<u8, ScriptError> {
        Ok(self.number("a key code from 0 to 255")?.1)
    }

    fn error(&self, expected: impl Into<String>) -> ScriptError {
        self.error_at(self.at, expected)
    }

    fn error_at(&self, at: usize, expected: impl Into<String>) -> ScriptError {
        let rest = &self.text[at..];
        let found: String = rest.split([';', ' ']).next().unwrap_or("").chars().take(20).collect();
        let found = match rest.chars().next() {
            None => "the end".to_owned(),
            Some(c) if found.is_empty() => format!("`{c}`"),
            Some(_) => format!("`{found}`"),
        };
        ScriptError { position: self.text[..at].chars().count() + 1, expected: expected.into(), found }
    }
}

/// Scripts as given on the command line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Script {
    pub fps: f64,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub mouse: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub keys: String,
    /// Local time of frame 0.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub date: String,
}

/// The inputs of frame 0, 1, 2 … of a run at a fixed step.
#[derive(Clone, Debug, Default)]
pub struct ScriptedInputs {
    fps: f64,
    mouse_events: Vec<ScriptedAction<MouseAction>>,
    key_events: Vec<ScriptedAction<KeyAction>>,
    date: Option<DateTime>,
    mouse: Mouse,
    keyboard: Keyboard,
    frame: i32,
    replay: Option<Arc<Recording>>,
}

impl ScriptedInputs {
    /// `fps` is finite and above 0.
    pub fn new(fps: f64) -> Self {
        Self { fps, ..Self::default() }
    }

    #[must_use]
    pub fn with_mouse(mut self, mut events: Vec<ScriptedAction<MouseAction>>) -> Self {
        events.sort_by_key(|e| e.frame);
        self.mouse_events = events;
        self
    }

    /// Scales the mouse's pixels to a picture that is this many times as wide and high.
    #[must_use]
    pub fn with_mouse_scale(mut self, factor: u32) -> Self {
        let factor = factor as f32;
        for event in &mut self.mouse_events {
            event.action = match event.action {
                MouseAction::Down(x, y) => MouseAction::Down(x * factor, y * factor),
                MouseAction::Move(x, y) => MouseAction::Move(x * factor, y * factor),
                MouseAction::Up => MouseAction::Up,
            };
        }
        self
    }

    #[must_use]
    pub fn with_keys(mut self, mut events: Vec<ScriptedAction<KeyAction>>) -> Self {
        events.sort_by_key(|e| e.frame);
        self.key_events = events;
        self
    }

    /// Sets the local time at frame 0, which advances with the frames. Without one `iDate` is (0, 0, 0, `iTime`).
    #[must_use]
    pub fn with_date(mut self, date: Option<DateTime>) -> Self {
        self.date = date;
        self
    }

    /// Replaces any script by recorded frames. After the last one time continues at the fixed step.
    #[must_use]
    pub fn with_replay(mut self, recording: Option<Arc<Recording>>) -> Self {
        self.replay = recording.filter(|recording| !recording.frames.is_empty());
        self
    }

    /// Returns the inputs of a script. Returns an error message if it is malformed.
    pub fn of_script(script: &Script) -> Result<Self, String> {
        if !script.fps.is_finite() || script.fps <= 0.0 {
            return Err(format!("{} frames per second cannot be", script.fps));
        }
        let mouse = parse_mouse(&script.mouse).map_err(|e| format!("mouse: {e}"))?;
        let keys = parse_keys(&script.keys).map_err(|e| format!("keys: {e}"))?;
        let date = Some(&script.date).filter(|date| !date.is_empty());
        let date = date.map(|date| date::parse(date)).transpose().map_err(|e| format!("date: {e}"))?;
        Ok(Self::new(script.fps).with_mouse(mouse).with_keys(keys).with_date(date))
    }

    /// Returns the script of the inputs; `None` if they are recorded.
    pub fn script(&self) -> Option<Script> {
        if self.replay.is_some() {
            return None;
        }
        let mouse = |at: &ScriptedAction<MouseAction>| match at.action {
            MouseAction::Down(x, y) => format!("{}:down {x},{y}", at.frame),
            MouseAction::Move(x, y) => format!("{}:move {x},{y}", at.frame),
            MouseAction::Up => format!("{}:up", at.frame),
        };
        let key = |at: &ScriptedAction<KeyAction>| match at.action {
            KeyAction::Down(code) => format!("{}:down {code}", at.frame),
            KeyAction::Up(code) => format!("{}:up {code}", at.frame),
        };
        Some(Script {
            fps: self.fps,
            mouse: self.mouse_events.iter().map(mouse).collect::<Vec<_>>().join("; "),
            keys: self.key_events.iter().map(key).collect::<Vec<_>>().join("; "),
            date: self.date.map(|date| date.to_string()).unwrap_or_default(),
        })
    }

    /// Returns the recording of the inputs, if there is one.
    pub fn recording(&self) -> Option<&Arc<Recording>> {
        self.replay.as_ref()
    }

    /// Returns a text that contains all the inputs, to compare two runs.
    pub fn written(&self) -> String {
        let Self { fps, mouse_events, key_events, date, replay, .. } = self;
        format!("{fps:?} {mouse_events:?} {key_events:?} {date:?} {replay:?}")
    }

    /// Returns how many frames the recording has, if there is one.
    pub fn recorded_frames(&self) -> Option<usize> {
        self.replay.as_ref().map(|recording| recording.frames.len())
    }

    /// Returns the changes that a recording makes before the next frame.
    pub fn next_change(&self) -> Option<Change> {
        let index = usize::try_from(self.frame).ok()?;
        self.replay.as_ref()?.change(index).map(|(change, _)| change)
    }

    fn replayed(&self, recording: &Recording, frame: usize) -> FrameInputs {
        if let Some((_, inputs)) = recording.change(frame) {
            return inputs.clone();
        }
        let last = recording.frames.len() - 1;
        let mut inputs = recording.frames[last].inputs.clone();
        let beyond = frame - last;
        inputs.frame = inputs.frame.saturating_add(beyond as i32);
        inputs.time_secs += beyond as f64 / self.fps;
        inputs.time_delta_secs = (1.0 / self.fps) as f32;
        // The press has been released.
        inputs.mouse[3] = -inputs.mouse[3].abs();
        inputs.keyboard.frame_painted();
        inputs
    }

    /// Restarts at frame 0.
    pub fn rewind(&mut self) {
        (self.frame, self.mouse, self.keyboard) = (0, Mouse::default(), Keyboard::default());
    }

    /// Advances to a frame as if those before it had been drawn. Takes as many steps as the script has actions,
    /// whatever the frame.
    pub fn skip_to(&mut self, frame: i32) {
        while self.frame < frame {
            let at = self.frame;
            // The events of a frame also affect the next one.
            let next = self.next_action(at.saturating_sub(1));
            match next {
                Some(action) if action <= at => drop(self.next_frame()),
                Some(action) => self.frame = action.min(frame),
                None => self.frame = frame,
            }
        }
    }

    /// Returns the first frame from `frame` on for which the script has an action.
    fn next_action(&self, frame: i32) -> Option<i32> {
        if self.replay.is_some() {
            return None;
        }
        fn of<A>(events: &[ScriptedAction<A>], frame: i32) -> Option<i32> {
            events.get(events.partition_point(|e| e.frame < frame)).map(|e| e.frame)
        }
        of(&self.mouse_events, frame).into_iter().chain(of(&self.key_events, frame)).min()
    }

    /// Number of the frame that [`ScriptedInputs::next_frame`] returns next.
    pub fn frame(&self) -> i32 {
        self.frame
    }

    /// Returns the inputs of the next frame, which counts as painted.
    pub fn next_frame(&mut self) -> FrameInputs {
        let frame = self.frame;
        self.frame = self.frame.saturating_add(1);
        if let Some(recording) = &self.replay {
            return self.replayed(recording, frame as usize);
        }
        for event in of_frame(&self.mouse_events, frame) {
            match event {
                MouseAction::Down(x, y) => self.mouse.press(x, y),
                MouseAction::Move(x, y) => self.mouse.move_to(x, y),
                MouseAction::Up => self.mouse.release(),
            }
        }
        for event in of_frame(&self.key_events, frame) {
            match event {
                KeyAction::Down(code) => self.keyboard.press(code),
                KeyAction::Up(code) => self.keyboard.release(code),
            }
        }
        let mut inputs = FrameInputs {
            mouse: self.mouse.next_frame(),
            pointer: self.mouse.pointer(),
            drag: self.mouse.dragged(),
            keyboard: self.keyboard.clone(),
            ..FrameInputs::at_fixed_step(frame, self.fps)
        };
        // A shader that reads only the seconds still moves.
        inputs.date[3] = inputs.time_secs as f32;
        if let Some(start) = self.date {
            let millis = (inputs.time_secs * 1000.0).round() as i64;
            inputs.date = date::i_date(start.saturating_add(SignedDuration::from_millis(millis)));
        }
        self.keyboard.frame_painted();
        inputs
    }
}

fn of_frame<A: Copy>(events: &[ScriptedAction<A>], frame: i32) -> impl Iterator<Item = A> {
    let from = events.partition_point(|e| e.frame < frame);
    events[from..].iter().take_while(move |e| e.frame == frame).map(|e| e.action)
}

#[cfg(test)]
mod tests;
