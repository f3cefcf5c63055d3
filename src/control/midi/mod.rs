//! MIDI: messages decoded to events, and the input devices.

mod decode;
pub mod host;
mod inputs;
#[cfg(feature = "midi")]
pub mod machine;
#[cfg(test)]
mod tests;

pub use decode::MidiDecoder;
pub use inputs::{MidiChoice, MidiInputs, MidiState};
