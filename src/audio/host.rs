//! Devices that sound comes from and goes to, in our words: [`AudioHost`] is the machine's sound, or a test's.

use std::{
    any::Any,
    fmt::Debug,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Instant,
};

/// The sound of a machine.
pub trait AudioHost: Send + Sync + Debug {
    fn output(&self) -> Box<dyn AudioOut>;
    fn input(&self) -> Box<dyn AudioIn>;
}

/// The form in which a device plays or records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Samples a second.
    pub rate: u32,
    pub channels: usize,
}

/// Fills a buffer of interleaved frames, whose first one is heard at a moment. It is called on a thread of the device and
/// must not wait.
pub type Fill = Box<dyn FnMut(&mut [f32], Instant) + Send>;

/// Takes interleaved frames that were recorded. It is called on a thread of the device and must not wait.
pub type Take = Box<dyn FnMut(&[f32]) + Send>;

/// A device that plays or records until this is dropped.
pub struct Opened {
    /// The device's name.
    pub name: String,
    pub format: Format,
    pub stream: Box<dyn Any + Send>,
}

/// Outputs of a machine.
pub trait AudioOut: Send {
    /// Returns the names of the devices.
    fn names(&mut self) -> Vec<String>;

    /// Opens the device of a name, or the system's default one. `fill` gives what fills its buffers once its format is
    /// known.
    fn open(
        &mut self,
        name: Option<&str>,
        fill: &mut dyn FnMut(Format) -> Fill,
        events: Events,
    ) -> Result<Opened, DeviceError>;
}

/// Inputs of a machine.
pub trait AudioIn: Send {
    /// Returns the names of the devices.
    fn names(&mut self) -> Vec<String>;

    /// Opens the device of a name, or the system's default one.
    fn open(
        &mut self,
        name: Option<&str>,
        take: &mut dyn FnMut(Format) -> Take,
        events: Events,
    ) -> Result<Opened, DeviceError>;
}

/// A device that cannot be opened, in words that people read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    #[error("this machine has no {0} device")]
    None(&'static str),
    #[error("there is no device \"{0}\"")]
    Unknown(String),
    #[error("{name} {why}")]
    Refused { name: String, why: String },
}

/// Takes what a device tells while it is open. A device that vanishes is told of once.
#[derive(Clone)]
pub struct Events {
    pub(crate) underruns: Arc<AtomicU64>,
    pub(crate) gone: Arc<dyn Fn(String) + Send + Sync>,
}

impl Events {
    /// A buffer came too late: a part of the sound was silence.
    pub fn underrun(&self) {
        self.underruns.fetch_add(1, Ordering::Relaxed);
    }

    /// The device plays or records no more.
    pub fn gone(&self, why: impl Into<String>) {
        (self.gone)(why.into());
    }
}
