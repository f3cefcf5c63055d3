//! Speed against error: the cost of a numerical method, and its distance from the truth.
//!
//! A [`Study`] lists methods (projects that the engine runs, in `assets/lab/`), the settings of each, grids, and a
//! reference that is exact or an f64 solver, written here and not in GLSL. [`run`] measures every point (a method at a
//! setting on a grid) and immediately appends it to a file of results; [`report`] makes tables and plots from such a
//! file. Has no window, and reads neither arguments nor environment variables: the command line passes them in. Reads
//! the clock only to measure the cost of a frame ([`cost`]).

pub mod background_run;
pub mod cost;
mod error;
pub mod metrics;
pub mod open;
mod page_style;
pub mod precision;
mod present;
pub mod preset_pictures;
pub mod reference;
pub mod report;
mod results;
mod rig;
pub mod run;
pub mod setup;
pub mod stability;
mod stability_record;
mod stop;
pub mod studies;
mod study;

pub use eddy_metrics::Number;
pub use eddy_playback::shard::Shard;
pub use error::LabError;
pub use present::PresentFingerprints;
pub use results::{CostRecord, ErrorRecord, FILE as RESULTS_FILE, Provenance, Record, Results};
pub use rig::{Field, Rig, Running};
pub use setup::Setup;
pub use stop::Stop;
pub use study::{Extent, HardCase, Measured, Method, Point, SpeedComparison, Study, Unit, three_of};
