//! External controls: OSC, MIDI and gamepads.
//!
//! Converts bytes to a [`ControlEvent`], and an event to the value of a uniform ([`moved`]). The bytes are untrusted:
//! decoding any input returns events or none, within the limits of [`eddy_project::limits`]. Devices are read on
//! threads of their own, which fill a [`ControlQueue`] and wake its reader. Nothing is opened before the user has
//! switched it on.
//!
//! MIDI devices are opened through the traits of [`midi::host`]: `midi::machine` (feature `midi`) implements them for
//! the machine, and [`fake`] for tests. Likewise gamepads through those of [`pads`] (feature `gamepad`).

#![warn(missing_docs)]

pub mod fake;
pub mod midi;
pub mod osc;
pub mod pads;
mod queue;
mod takeover;
mod values;

pub use queue::ControlQueue;
pub use takeover::{Movement, PickupSide, Takeover};
pub use values::{Moved, OWN_UNITS, direct, moved, place_of};

use eddy_project::ControlAddress;
use std::sync::Arc;

/// A callback that is called on another thread when there is something to take.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// A movement of a control.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlEvent {
    /// The control that moved.
    pub source: ControlAddress,
    /// The position, from 0 to 1, of a control of MIDI or a gamepad. For OSC the number of the argument unchanged,
    /// never NaN or infinite: true is 1 and false is 0.
    pub value: f64,
}
