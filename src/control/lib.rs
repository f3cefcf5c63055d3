//! Controls that people bring: OSC, MIDI and gamepads.
//!
//! Owns the way from bytes to a [`ControlEvent`], and from an event to the value of a uniform ([`moved`]). Bytes are anybody's:
//! whatever comes, decoding gives events or none, within the limits of [`eddy_project::limits`]. Devices are read on threads of
//! their own, which fill a [`ControlQueue`] and wake its reader. Nothing is opened before a person has switched it on.
//!
//! MIDI devices come through the traits of [`midi::host`]: `midi::machine` (feature `midi`) has those of the machine, and
//! [`fake`] those of a test. So do gamepads through those of [`pads`] (feature `gamepad`).

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

/// Called on another thread when there is something to take.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// A control has moved.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlEvent {
    pub source: ControlAddress,
    /// The position, from 0 to 1, of a control of MIDI or a gamepad. Of OSC the number of the argument as it came, never NaN or infinite: true
    /// is 1 and false is 0.
    pub value: f64,
}
