//! Gamepads: what they send, and the thread that reads them. [`PadHost`] is the machine's gamepads, or a test's; `machine`
//! (feature `gamepad`) has those of the machine.

mod inputs;
#[cfg(feature = "gamepad")]
pub mod machine;

pub use inputs::{PadInputs, PadState};

use eddy_project::PadPart;
use std::{fmt::Debug, time::Duration};

/// The gamepads of a machine.
pub trait PadHost: Send + Sync + Debug {
    /// Begins to listen to all of them, on the thread that asks. Err: why it cannot, in words that people read.
    fn open(&self) -> Result<Box<dyn PadIn>, String>;
}

/// Gamepads that are listened to until this is dropped.
pub trait PadIn {
    /// Waits for something to happen, at most for so long. `None`: nothing has.
    fn next(&mut self, patience: Duration) -> Option<PadEvent>;
}

/// Something that has happened to a gamepad. Pads are counted from 0, and one that comes back has its number again.
#[derive(Clone, Debug, PartialEq)]
pub enum PadEvent {
    Connected {
        pad: usize,
        name: String,
    },
    Disconnected {
        pad: usize,
    },
    /// Axes go from -1 to 1, to the right and up; buttons from 0 to 1.
    Moved {
        pad: usize,
        part: PadPart,
        value: f32,
    },
}
