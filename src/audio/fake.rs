//! Audio devices for tests: an output and an input that run when the test tells them to, by the test's own clock.

use crate::host::{AudioHost, AudioIn, AudioOut, DeviceError, Events, Fill, Format, Opened, Take};
use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// The output and the input of a simulated machine.
#[derive(Clone, Debug, Default)]
pub struct FakeHost {
    /// The loudspeakers.
    pub out: FakeOut,
    /// The microphone, which is not plugged in at first.
    pub input: FakeIn,
}

impl AudioHost for FakeHost {
    fn output(&self) -> Box<dyn AudioOut> {
        Box::new(self.out.clone())
    }

    fn input(&self) -> Box<dyn AudioIn> {
        Box::new(self.input.clone())
    }
}

/// An output that stores what it plays.
#[derive(Clone, Debug)]
pub struct FakeOut(Arc<Mutex<Out>>);

struct Out {
    names: Vec<String>,
    format: Format,
    /// The frames per buffer.
    buffer: usize,
    /// The device's clock is faster than real time by this share: 1e-4 is 100 ppm.
    drift: f64,
    open: Option<Playing>,
    /// Everything that was played, with the moment at which it is heard.
    heard: Vec<(Instant, Vec<f32>)>,
    attempts: usize,
}

struct Playing {
    fill: Fill,
    events: Events,
    /// The moment at which it started, and the frames since then.
    since: Option<Instant>,
    frames: u64,
}

impl std::fmt::Debug for Out {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Out").field("names", &self.names).finish_non_exhaustive()
    }
}

impl Default for FakeOut {
    fn default() -> Self {
        Self::new(Format { rate: 44_100, channels: 2 }, 441)
    }
}

impl FakeOut {
    /// Creates a device "speakers" that plays buffers of this number of frames.
    pub fn new(format: Format, buffer: usize) -> Self {
        let names = vec!["speakers".into()];
        let (open, heard) = (None, Vec::new());
        Self(Arc::new(Mutex::new(Out { names, format, buffer, drift: 0.0, open, heard, attempts: 0 })))
    }

    fn lock(&self) -> MutexGuard<'_, Out> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes the device's clock run faster than real time by a share.
    pub fn set_drift(&self, share: f64) {
        self.lock().drift = share;
    }

    /// Sets the available devices. An open device that is missing from the list vanishes.
    pub fn set_names(&self, names: &[&str]) {
        let mut out = self.lock();
        out.names = names.iter().map(|name| (*name).to_owned()).collect();
        let gone = if out.names.is_empty() { out.open.take() } else { None };
        drop(out);
        if let Some(playing) = gone {
            playing.events.gone("speakers: unplugged");
        }
    }

    /// Returns whether a device of the output is open.
    pub fn is_open(&self) -> bool {
        self.lock().open.is_some()
    }

    /// Returns the number of attempts to open a device.
    pub fn attempts(&self) -> usize {
        self.lock().attempts
    }

    /// Plays all buffers that start before a moment.
    pub fn run_until(&self, now: Instant) {
        let mut out = self.lock();
        let (format, buffer, drift) = (out.format, out.buffer, out.drift);
        let Some(mut playing) = out.open.take() else { return };
        let since = *playing.since.get_or_insert(now);
        loop {
            let secs = playing.frames as f64 / f64::from(format.rate) / (1.0 + drift);
            let heard_at = since + Duration::from_secs_f64(secs);
            if heard_at > now {
                break;
            }
            let mut samples = vec![0.0; buffer * format.channels];
            (playing.fill)(&mut samples, heard_at);
            playing.frames += buffer as u64;
            out.heard.push((heard_at, samples));
        }
        out.open = Some(playing);
    }

    /// Takes what was played, as interleaved frames of all channels, with the moment of the first frame, computed from
    /// the last buffer. If the device was reopened meanwhile, that moment is correct only for the frames since then.
    pub fn take_heard(&self) -> (Option<Instant>, Vec<f32>) {
        let mut out = self.lock();
        let format = out.format;
        let heard = std::mem::take(&mut out.heard);
        let last = heard.last().map(|(at, samples)| (*at, samples.len()));
        let all: Vec<f32> = heard.into_iter().flat_map(|(_, samples)| samples).collect();
        let first = last.map(|(at, count)| {
            let before = (all.len() - count) as f64 / format.channels as f64;
            at - Duration::from_secs_f64(before / f64::from(format.rate) / (1.0 + out.drift))
        });
        (first, all)
    }
}

/// Closes a test's device when it is dropped.
struct CloseOnDrop(Arc<Mutex<Out>>, u64);

impl Drop for CloseOnDrop {
    fn drop(&mut self) {
        let mut out = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if out.attempts as u64 == self.1 {
            out.open = None;
        }
    }
}

impl AudioOut for FakeOut {
    fn names(&mut self) -> Vec<String> {
        self.lock().names.clone()
    }

    fn open(
        &mut self,
        name: Option<&str>,
        fill: &mut dyn FnMut(Format) -> Fill,
        events: Events,
    ) -> Result<Opened, DeviceError> {
        let mut out = self.lock();
        out.attempts += 1;
        let known = match name {
            None => out.names.first().cloned().ok_or(DeviceError::None("output"))?,
            Some(name) if out.names.iter().any(|known| known == name) => name.to_owned(),
            Some(name) => return Err(DeviceError::Unknown(name.to_owned())),
        };
        let format = out.format;
        out.open = Some(Playing { fill: fill(format), events, since: None, frames: 0 });
        let closer = CloseOnDrop(self.0.clone(), out.attempts as u64);
        Ok(Opened { name: known, format, stream: Box::new(closer) })
    }
}

/// An input that hears the samples that a test provides.
#[derive(Clone, Debug, Default)]
pub struct FakeIn(Arc<Mutex<In>>);

#[derive(Default)]
struct In {
    is_there: bool,
    take: Option<Take>,
}

impl std::fmt::Debug for In {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("In").field("is_there", &self.is_there).finish_non_exhaustive()
    }
}

impl FakeIn {
    fn lock(&self) -> MutexGuard<'_, In> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Plugs in a microphone with one channel at 44,100 samples per second.
    pub fn plug_in(&self) {
        self.lock().is_there = true;
    }

    /// Returns whether the microphone is open.
    pub fn is_open(&self) -> bool {
        self.lock().take.is_some()
    }

    /// Passes samples to the microphone, if it is open.
    pub fn hear(&self, samples: &[f32]) {
        if let Some(take) = &mut self.lock().take {
            take(samples);
        }
    }
}

struct UnplugOnDrop(Arc<Mutex<In>>);

impl Drop for UnplugOnDrop {
    fn drop(&mut self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take = None;
    }
}

impl AudioIn for FakeIn {
    fn names(&mut self) -> Vec<String> {
        if self.lock().is_there { vec!["microphone".into()] } else { Vec::new() }
    }

    fn open(
        &mut self,
        _: Option<&str>,
        take: &mut dyn FnMut(Format) -> Take,
        _: Events,
    ) -> Result<Opened, DeviceError> {
        let mut input = self.lock();
        if !input.is_there {
            return Err(DeviceError::None("input"));
        }
        let format = Format { rate: crate::SAMPLE_RATE, channels: 1 };
        input.take = Some(take(format));
        Ok(Opened { name: "microphone".into(), format, stream: Box::new(UnplugOnDrop(self.0.clone())) })
    }
}
