//! Gamepads: their events, and the thread that reads them. [`PadHost`] is the machine's gamepads, or a test's;
//! `machine` (feature `gamepad`) implements it for the machine.

mod inputs;
#[cfg(feature = "gamepad")]
pub mod machine;

pub use inputs::{PadInputs, PadState};

use eddy_project::PadPart;
use std::{fmt::Debug, time::Duration};

/// The gamepads of a machine.
pub trait PadHost: Send + Sync + Debug {
    /// Starts to listen to all of them, on the calling thread. The error is a message for users.
    fn open(&self) -> Result<Box<dyn PadIn>, String>;
}

/// Gamepads that are listened to until this is dropped.
pub trait PadIn {
    /// Waits at most `patience` for an event. `None` if there was none.
    fn next(&mut self, patience: Duration) -> Option<PadEvent>;
}

/// An event of a gamepad. Pads are numbered from 0, and a pad that is plugged in again keeps its number.
#[derive(Clone, Debug, PartialEq)]
pub enum PadEvent {
    /// A pad was plugged in, or was found when listening started.
    Connected {
        /// The number of the pad.
        pad: usize,
        /// The model, as the system names it.
        name: String,
    },
    /// A pad was unplugged; its number stays reserved for it while others are free.
    Disconnected {
        /// The number of the pad.
        pad: usize,
    },
    /// An axis or a button has another position.
    Moved {
        /// The number of the pad.
        pad: usize,
        /// The axis or button.
        part: PadPart,
        /// Axes go from -1 to 1, to the right and up; buttons from 0 to 1.
        value: f32,
    },
}
