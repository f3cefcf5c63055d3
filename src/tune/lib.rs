//! Speed against error of any program: finds its knobs, measures what each does to time and picture, and searches for the
//! cheapest setting within a bound of error, or the most exact one within a budget of time.
//!
//! [`Found`] lists the knobs of a project ([`eddy_glsl::knobs`] has the rules for numbers in texts), [`tune`] searches,
//! and [`applied`] makes the project with a setting. Errors are measured against the program's own converged setting
//! ([`converge`]). Measures durations, and knows neither windows nor files.

mod bench;
pub mod converge;
mod discover;
mod knob;
mod metric;
mod savings;
pub mod search;
mod tuner;
mod tuning;

pub use bench::Scene;
pub use converge::Convergence;
pub use discover::{Found, Rejected};
pub use knob::{Kind, Knob, Range, Target, applied};
pub use metric::{Bound, Metric};
pub use savings::Place;
pub use search::{Goal, Point};
pub use tuner::{Progress, Report, Request, TuneError, tune};
pub use tuning::{Effect, Proposal, Tuning, default_frames};
