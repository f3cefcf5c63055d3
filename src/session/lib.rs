//! An open project over time.
//!
//! Owns the clock, the mouse and the keyboard as Shadertoy's uniforms show them; the open documents and what of them is
//! unsaved; the compile worker; the watch on the project's folder; pictures written to disk; scripted runs without a
//! window. A front end hands it [`Command`]s and calls [`Session::tick`]; everything it shows it reads from
//! `&Session`. Draws no widget and knows no window.

mod analyse;
mod analysis;
mod apply;
mod arrivals;
pub mod audit;
mod auditing;
pub mod buffers;
pub mod capture;
pub mod clock;
pub mod command;
pub mod comparing;
mod compile;
mod costs;
pub mod date;
mod debounce;
mod documents;
mod draw;
mod drawing;
mod export;
mod files;
mod fps;
mod frames;
mod halt;
mod halting;
mod kept_files;
mod last_pictures;
mod marker;
mod measures;
pub mod measuring;
mod miniatures;
pub mod mouse;
mod next_project;
pub mod nonfinite;
mod notices;
pub mod npy;
pub mod offline;
mod options;
mod pace;
pub mod parting;
mod pass_history;
mod passes;
mod picture_check;
pub mod probe;
mod queries;
mod reads;
mod recent;
mod record;
mod recorder;
pub mod recording;
mod recover;
mod recovery;
pub mod reduction;
mod reload;
mod rename;
mod reopen;
mod replay;
mod replaying;
pub mod revision;
mod runs;
pub mod script;
mod seek;
pub mod seeking;
mod stamps;
mod state;
mod still;
mod structure;
mod template;
pub mod trace;
mod tracing;
pub mod trial;
mod uniform_names;
mod uniforms_of_texts;
pub mod view;
mod walked;
mod watch;
mod worker;

pub use analysis::TabAnalysis;
pub use auditing::{AuditMap, WorstPixel};
pub use command::{Answer, Command, DiffLine, Question, Recovered, RecoveredTab, Request, Then};
pub use costs::{PassCosts, TimedPass};
pub use export::directive_errors;
pub use options::{SessionError, SessionOptions};
pub use pass_history::PassStep;
pub use recent::RecentProject;
pub use recovery::{KEPT_DAYS, folder as recovery_folder, place_for_replaced};
pub use replay::ReplayView;
pub use state::Session;
pub use tracing::TraceView;
pub use view::{
    About, CompileState, Halt, Level, Meanwhile, Notice, Outcome, Place, TabDiagnostic, TabEdit, TabFix, TabLabel,
    Tick, Transport,
};
