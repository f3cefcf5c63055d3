//! MIDI devices in our words: [`MidiHost`] is the machine's MIDI, or a test's.

use std::{any::Any, fmt::Debug};

/// The MIDI of a machine.
pub trait MidiHost: Send + Sync + Debug {
    fn input(&self) -> Box<dyn MidiIn>;
}

/// Takes bytes that a device sent. It is called on a thread of the device and must not wait.
pub type Take = Box<dyn FnMut(&[u8]) + Send>;

/// A device that sends until this is dropped.
pub type Opened = Box<dyn Any + Send>;

/// Devices of a machine that send.
pub trait MidiIn: Send {
    /// Returns the names of the devices that are there now, each once.
    fn names(&mut self) -> Result<Vec<String>, MidiError>;

    /// Opens the device of a name.
    fn open(&mut self, name: &str, take: Take) -> Result<Opened, MidiError>;
}

/// A device that cannot be opened, in words that people read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MidiError {
    #[error("this machine has no MIDI")]
    NoMidi,
    #[error("there is no device \"{0}\"")]
    Unknown(String),
    #[error("{name}: {why}")]
    Refused { name: String, why: String },
}
