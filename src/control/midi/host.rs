//! An abstraction of MIDI devices: [`MidiHost`] is the machine's MIDI, or a test's.

use std::{any::Any, fmt::Debug};

/// The MIDI devices of a machine.
pub trait MidiHost: Send + Sync + Debug {
    fn input(&self) -> Box<dyn MidiIn>;
}

/// Takes bytes that a device sent. It is called on the device's thread and must not block.
pub type Take = Box<dyn FnMut(&[u8]) + Send>;

/// A device that sends until this is dropped.
pub type Opened = Box<dyn Any + Send>;

/// The MIDI inputs of a machine.
pub trait MidiIn: Send {
    /// Returns the names of the connected devices, without duplicates.
    fn names(&mut self) -> Result<Vec<String>, MidiError>;

    /// Opens the device of this name.
    fn open(&mut self, name: &str, take: Take) -> Result<Opened, MidiError>;
}

/// The reason why a device cannot be opened, as shown to users.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MidiError {
    #[error("this machine has no MIDI")]
    NoMidi,
    #[error("there is no device \"{0}\"")]
    Unknown(String),
    #[error("{name}: {why}")]
    Refused { name: String, why: String },
}
