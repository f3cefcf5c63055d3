//! The input: samples of a microphone, resampled to [`SAMPLE_RATE`] and stored for as long as the analyser looks back.

use crate::{
    Analyser, SAMPLE_RATE, Spectrum,
    host::{AudioHost, AudioIn, DeviceError, Events, Format, Opened, Take},
    keeper::{DeviceState, Keeper, Work},
    kernel::Kernel,
};
use rtrb::{Consumer, Producer, RingBuffer};
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
    time::Instant,
};

/// Seconds of sound that may be buffered between a device and the reader.
const WAITING_SECS: usize = 4;
/// The number of samples that are kept for the analyser: 10 s.
const KEPT: usize = 10 * SAMPLE_RATE as usize;
/// The number of calls of the analyser that are kept: it uses no more.
const CALLS: usize = 64;

/// Samples from the device, mono, at its own rate.
struct InputStream {
    rate: u32,
    samples: Consumer<f32>,
}

type Shared = Arc<Mutex<Option<InputStream>>>;

/// Records while it is switched on.
pub struct Microphone {
    keeper: Keeper<Recording>,
    line: Shared,
    heard: RecordedSamples,
}

impl Microphone {
    /// Starts a thread. `wake` is called from it when the state of the device has changed. Recording is off initially.
    pub fn on_thread(host: &dyn AudioHost, wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let (recording, line) = Recording::new(host);
        Ok(Self { keeper: Keeper::on_thread("microphone", recording, wake)?, line, heard: RecordedSamples::default() })
    }

    /// Creates a microphone without a thread: [`Microphone::step`] opens the device.
    pub fn here(host: &dyn AudioHost) -> Self {
        let (recording, line) = Recording::new(host);
        Self { keeper: Keeper::here(recording), line, heard: RecordedSamples::default() }
    }

    /// Switches it on or off, and discards what was recorded.
    pub fn switch(&mut self, on: bool) {
        self.keeper.order(on);
        self.heard = RecordedSamples::default();
    }

    /// Requests a device by its name, or the system's default one.
    pub fn choose(&mut self, device: Option<String>) {
        self.keeper.choose(device);
    }

    /// Requests the names of the devices.
    pub fn ask_names(&mut self) {
        self.keeper.ask_names();
    }

    /// Returns the names of the devices, once requested.
    pub fn names(&self) -> Option<Vec<String>> {
        self.keeper.names()
    }

    /// Returns the state of the device; a change of it calls `wake`.
    pub fn state(&self) -> DeviceState {
        self.keeper.state()
    }

    /// Takes what was recorded since the last call, and does pending work if there is no thread.
    pub fn step(&mut self, now: Instant) {
        self.keeper.step(now);
        if let Some(line) = &mut *self.line.lock().unwrap_or_else(PoisonError::into_inner) {
            let ratio = f64::from(line.rate) / f64::from(SAMPLE_RATE);
            while let Ok(sample) = line.samples.pop() {
                self.heard.add(sample, ratio);
            }
        }
    }

    /// Calls the analyser, as Shadertoy does once per frame. `None` if nothing has been recorded yet.
    pub fn frame(&mut self) -> Option<Arc<Spectrum>> {
        self.heard.frame()
    }

    /// Returns the largest sample of the last 50 ms, from 0 to 1.
    pub fn level(&self) -> f32 {
        self.heard.level()
    }
}

/// Recorded samples, and the frames that analysed them.
#[derive(Default)]
struct RecordedSamples {
    kernel: Kernel,
    /// Samples of the device that are not resampled yet, and the position of the next output sample among them.
    raw: VecDeque<f32>,
    position: f64,
    samples: VecDeque<f32>,
    /// The number of samples before the first of `samples`.
    forgotten: i64,
    /// The positions at which the analyser was called, the newest first.
    calls: VecDeque<i64>,
    analyser: Analyser,
    newest: Option<Arc<Spectrum>>,
}

impl RecordedSamples {
    /// Adds a sample of a device with `ratio` samples per output sample.
    fn add(&mut self, sample: f32, ratio: f64) {
        let sample = if sample.is_finite() { sample } else { 0.0 };
        if ratio == 1.0 {
            return self.keep(sample);
        }
        let reach = Kernel::reach(ratio);
        if self.raw.is_empty() && self.samples.is_empty() {
            // Silence precedes the first sample.
            self.raw.extend(std::iter::repeat_n(0.0, reach as usize));
            self.position = reach as f64;
        }
        self.raw.push_back(sample);
        while self.position.floor() as i64 + reach < self.raw.len() as i64 {
            let [mono, _] = self.kernel.read(self.position, ratio, |n| {
                [usize::try_from(n).ok().and_then(|n| self.raw.get(n)).copied().unwrap_or(0.0); 2]
            });
            self.keep(mono);
            self.position += ratio;
        }
        let old = (self.position.floor() as usize).saturating_sub(reach as usize).min(self.raw.len());
        self.raw.drain(..old);
        self.position -= old as f64;
    }

    fn keep(&mut self, sample: f32) {
        if self.samples.len() == KEPT {
            self.samples.pop_front();
            self.forgotten += 1;
        }
        self.samples.push_back(sample);
    }

    /// Calls the analyser if there are new samples.
    fn frame(&mut self) -> Option<Arc<Spectrum>> {
        let now = self.forgotten + self.samples.len() as i64;
        if now == 0 {
            return None;
        }
        if self.calls.front() != Some(&now) {
            self.calls.push_front(now);
            self.calls.truncate(CALLS);
            let sample = |n: i64| {
                let index = usize::try_from(n - self.forgotten).ok();
                index.and_then(|index| self.samples.get(index)).copied().unwrap_or(0.0)
            };
            self.newest = Some(Arc::new(self.analyser.texture(self.calls.iter().copied(), sample)));
        }
        self.newest.clone()
    }

    fn level(&self) -> f32 {
        let recent = self.samples.iter().rev().take(SAMPLE_RATE as usize / 20);
        recent.fold(0.0, |most: f32, sample| most.max(sample.abs())).min(1.0)
    }
}

struct Recording {
    input: Box<dyn AudioIn>,
    is_on: bool,
    line: Shared,
}

impl Recording {
    fn new(host: &dyn AudioHost) -> (Self, Shared) {
        let line = Shared::default();
        (Self { input: host.input(), is_on: false, line: line.clone() }, line)
    }

    fn set_line(&self, line: Option<InputStream>) {
        *self.line.lock().unwrap_or_else(PoisonError::into_inner) = line;
    }
}

/// Returns a callback that stores the mean of each frame's channels. Samples that do not fit are dropped.
fn into_ring(mut to: Producer<f32>, channels: usize) -> Take {
    Box::new(move |frames: &[f32]| {
        for frame in frames.chunks_exact(channels.max(1)) {
            let _ = to.push(frame.iter().sum::<f32>() / frame.len() as f32);
        }
    })
}

impl Work for Recording {
    type Order = bool;

    fn take(&mut self, on: bool) {
        self.is_on = on;
        if !on {
            self.set_line(None);
        }
    }

    fn needs_device(&self) -> bool {
        self.is_on
    }

    /// A microphone that is switched off is closed at once, so that the system's indicator turns off.
    fn lingers(&self) -> bool {
        false
    }

    fn open(&mut self, name: Option<&str>, events: Events) -> Result<Opened, DeviceError> {
        let mut made = None;
        let mut take = |format: Format| -> Take {
            let (to, samples) = RingBuffer::new(WAITING_SECS * format.rate as usize);
            made = Some(InputStream { rate: format.rate, samples });
            into_ring(to, format.channels)
        };
        let opened = self.input.open(name, &mut take, events)?;
        self.set_line(made);
        Ok(opened)
    }

    fn feed(&mut self) -> bool {
        true
    }

    fn closed(&mut self) {
        self.set_line(None);
    }

    fn names(&mut self) -> Vec<String> {
        self.input.names()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BINS;
    use std::f64::consts::TAU;

    fn heard(hertz: f64, rate: f64) -> Spectrum {
        let mut heard = RecordedSamples::default();
        let mut newest = None;
        for n in 0..(rate as usize) {
            heard.add((0.05 * (TAU * hertz * n as f64 / rate).sin()) as f32, rate / f64::from(SAMPLE_RATE));
            if n % (rate as usize / 60) == 0 {
                newest = heard.frame();
            }
        }
        *newest.unwrap()
    }

    #[test]
    fn a_tone_is_in_the_right_bin_at_every_device_rate() {
        let peak = |bytes: &Spectrum| (0..BINS).max_by_key(|bin| bytes[*bin]).unwrap();
        let exact = (1000.0 / f64::from(SAMPLE_RATE) * 2048.0_f64).round() as usize;
        for rate in [16_000.0, 44_100.0, 48_000.0, 96_000.0] {
            let bytes = heard(1000.0, rate);
            assert!(peak(&bytes).abs_diff(exact) <= 1, "{rate}: {}", peak(&bytes));
        }
    }

    #[test]
    fn the_analyser_runs_once_per_frame_with_new_samples() {
        let mut heard = RecordedSamples::default();
        assert_eq!(heard.frame(), None);
        (0..3000).for_each(|n| heard.add((n as f32 * 0.3).sin() * 0.1, 1.0));
        let first = heard.frame().unwrap();
        assert!(Arc::ptr_eq(&first, &heard.frame().unwrap()), "nothing new, no smoothing");
        (0..735).for_each(|n| heard.add((n as f32 * 0.3).sin() * 0.1, 1.0));
        let second = heard.frame().unwrap();
        assert!(second.iter().zip(&first[..BINS]).any(|(now, before)| now > before), "it rises by the smoothing");
        // Far more than is kept.
        (0..2 * KEPT).for_each(|_| heard.add(0.0, 1.0));
        assert_eq!(heard.samples.len(), KEPT);
        assert_eq!(heard.frame().unwrap()[BINS], 128);
    }
}
