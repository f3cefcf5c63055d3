//! An abstraction of audio devices: [`AudioHost`] is the machine's audio, or a test's.

use std::{
    any::Any,
    fmt::Debug,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Instant,
};

/// The audio devices of a machine.
pub trait AudioHost: Send + Sync + Debug {
    /// Returns the outputs, none of which is open yet.
    fn output(&self) -> Box<dyn AudioOut>;
    /// Returns the inputs, none of which is open yet.
    fn input(&self) -> Box<dyn AudioIn>;
}

/// The format in which a device plays or records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Samples per second.
    pub rate: u32,
    /// Samples per frame.
    pub channels: usize,
}

/// Fills a buffer of interleaved frames, the first of which is heard at a moment. It is called on the device's thread
/// and must not block.
pub type Fill = Box<dyn FnMut(&mut [f32], Instant) + Send>;

/// Takes recorded interleaved frames. It is called on the device's thread and must not block.
pub type Take = Box<dyn FnMut(&[f32]) + Send>;

/// A device that plays or records until this is dropped.
pub struct Opened {
    /// The device's name.
    pub name: String,
    /// The device's own format, in which `fill` or `take` gets its buffers.
    pub format: Format,
    /// Closes the device when it is dropped.
    pub stream: Box<dyn Any + Send>,
}

/// The outputs of a machine.
pub trait AudioOut: Send {
    /// Returns the names of the devices.
    fn names(&mut self) -> Vec<String>;

    /// Opens the device of this name, or the system's default one. Once its format is known, `fill` returns the
    /// callback that fills its buffers.
    fn open(
        &mut self,
        name: Option<&str>,
        fill: &mut dyn FnMut(Format) -> Fill,
        events: Events,
    ) -> Result<Opened, DeviceError>;
}

/// The inputs of a machine.
pub trait AudioIn: Send {
    /// Returns the names of the devices.
    fn names(&mut self) -> Vec<String>;

    /// Opens the device of this name, or the system's default one.
    fn open(
        &mut self,
        name: Option<&str>,
        take: &mut dyn FnMut(Format) -> Take,
        events: Events,
    ) -> Result<Opened, DeviceError>;
}

/// The reason why a device cannot be opened, as shown to users.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// The system has no default device; contains "input" or "output".
    #[error("this machine has no {0} device")]
    None(&'static str),
    /// No device has this name.
    #[error("there is no device \"{0}\"")]
    Unknown(String),
    /// The device is there and does not open, for instance while another program uses it.
    #[error("{name} {why}")]
    Refused {
        /// The device's name.
        name: String,
        /// The rest of the sentence, which says why.
        why: String,
    },
}

/// Callbacks for the events of an open device. A device that vanishes is reported once.
#[derive(Clone)]
pub struct Events {
    pub(crate) underruns: Arc<AtomicU64>,
    pub(crate) gone: Arc<dyn Fn(String) + Send + Sync>,
}

impl Events {
    /// Reports an underrun: a buffer was late, so a part of the sound was silent.
    pub fn underrun(&self) {
        self.underruns.fetch_add(1, Ordering::Relaxed);
    }

    /// Reports that the device no longer plays or records.
    pub fn gone(&self, why: impl Into<String>) {
        (self.gone)(why.into());
    }
}
