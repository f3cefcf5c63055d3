//! An abstraction of MIDI devices: [`MidiHost`] is the machine's MIDI, or a test's.

use std::{any::Any, fmt::Debug};

/// The MIDI devices of a machine.
pub trait MidiHost: Send + Sync + Debug {
    /// Returns the inputs, none of which is open yet.
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
    /// The system has no MIDI service.
    #[error("this machine has no MIDI")]
    NoMidi,
    /// No connected device has this name.
    #[error("there is no device \"{0}\"")]
    Unknown(String),
    /// The device is connected and does not open, for instance while another program uses it.
    #[error("{name}: {why}")]
    Refused {
        /// The device's name.
        name: String,
        /// The reason, as the system gives it.
        why: String,
    },
}
