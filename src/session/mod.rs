//! An open project over time.
//!
//! Owns the clock, the mouse and the keyboard as Shadertoy's uniforms show them; the open documents and what of them is
//! unsaved; the compile worker; the watch on the project's folder; pictures written to disk; scripted runs without a
//! window. A front end hands it [`Command`]s and calls [`Session::tick`]; everything it shows it reads from
//! `&Session`. Draws no widget and knows no window.

mod analyse;
mod analysis;
mod apply;
pub mod capture;
pub mod clock;
pub mod command;
mod compile;
mod costs;
pub mod date;
mod debounce;
mod documents;
mod files;
mod frames;
pub mod mouse;
pub mod npy;
pub mod offline;
mod reload;
pub mod script;
mod stamps;
mod state;
mod structure;
mod template;
#[cfg(test)]
pub(crate) mod testing;
pub mod view;
mod watch;
mod worker;

pub use analysis::TabAnalysis;
pub use command::{Answer, Command, DiffLine, Question, Request, Then};
pub use costs::{PassCosts, TimedPass};
pub use state::{Session, SessionError, SessionOptions};
pub use view::{CompileState, Level, Meanwhile, Notice, Outcome, Place, TabDiagnostic, TabLabel, Tick, Transport};
