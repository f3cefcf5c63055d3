//! Stability: whether a simulation stays within the bounds of what it simulates, under all kinds of disturbances.
//!
//! A [`CheckedProject`] is a project with [assertions](eddy_playback::assertion): for a quantity of a pass (a component,
//! a length, a mean, an energy, its roughness) the range that physics or the method's theory allows. The presets' are
//! files that [`presets`] reads, each range with its justification; any other project must be finite and within [`ANY_BOUND`]. [`cases`] lists
//! the tests: long undisturbed runs, beyond the Courant number, every slider at both ends and every pair of sliders at
//! theirs, mouse drags, odd sizes, long and uneven time steps, a resize, a texel that is not a number. Presets add
//! cases of their own. [`run`] draws each case and records the result, with the first frame and texel outside of a
//! bound, and the number of frames until the project recovers. Draws nothing itself and knows no window.

pub mod cases;
mod drive;
mod inputs;
mod judge;
pub mod pairs;
pub mod presets;
mod report;
pub mod run;
mod subject;

pub use crate::stability_record::{Kind, Outcome, Recovery, StabilityRecord, Violation};
pub use cases::Case;
pub use drive::Driver;
pub use report::{table, write, write_of};
pub use subject::{ANY_BOUND, CheckedProject, parse_bound};

use eddy_playback::assertion::{Quantity, Reduction};

/// Returns the name of a quantity in the file of results: "buffer_a |xy|", "image xyzw", "buffer_c mean z".
fn record_name(quantity: &Quantity) -> String {
    format!("{} {}", quantity.pass.key(), quantity_name(quantity))
}

/// Returns the part of that name that does not name the pass.
fn quantity_name(quantity: &Quantity) -> String {
    let letters = match quantity.is_length {
        true => format!("|{}|", quantity.letters()),
        false => quantity.letters(),
    };
    quantity.reduction.map_or(letters.clone(), |reduction: Reduction| format!("{} {letters}", reduction.name()))
}
