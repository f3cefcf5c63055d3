//! An open project over time.
//!
//! Owns the clock, the mouse and the keyboard as Shadertoy's uniforms show them; the open documents and their unsaved
//! parts; the compile worker; the watcher of the project's folder; pictures written to disk; scripted runs without a
//! window. A front end sends it [`Command`]s and calls [`Session::tick`]; everything that it shows is read from
//! `&Session`. Draws no widgets and knows no window.

mod analysis;
mod apply;
mod audio;
mod audit;
pub mod buffers;
mod canvas;
mod captures;
pub mod command;
mod compare;
mod compile;
mod controls;
mod conversion;
mod costs;
mod counts;
mod debounce;
mod devices;
mod disk;
mod documents;
mod draw;
mod drawing;
mod export;
mod export_page;
mod files;
mod films;
mod frames;
mod halt;
mod host;
mod imports;
mod kept_files;
mod last_pictures;
pub mod measures;
mod miniatures;
mod next_project;
mod nonfinite;
mod notices;
mod open_project;
mod options;
mod panic_report;
mod pass_history;
mod passes;
mod playback;
pub mod probe;
mod queries;
mod read_back;
mod recent;
mod recovery;
mod rename;
mod reopen;
mod runs;
mod scene;
mod services;
mod sound;
mod state;
mod structure;
mod template;
mod trace;
mod transport;
mod tune;
mod uniforms;
pub mod view;

pub use analysis::TabAnalysis;
pub use audio::{MicrophoneView, OutputView};
pub use audit::{AuditMap, WorstPixel};
pub use command::{
    Answer, CameraCommand, CanvasCommand, CaptureCommand, Command, ControlCommand, DiffLine, EditCommand, FileCommand,
    FilmCommand, HaltCommand, InputCommand, NoticeCommand, PendingAction, Question, Recovered, RecoveredTab, Request,
    SoundCommand, ToolCommand, TransportCommand, ViewCommand,
};
pub use controls::ControlsView;
pub use costs::{PassCosts, TimedPass};
pub use counts::{CountedPass, CountsView};
pub use devices::{CameraState, DeviceConsent};
pub use eddy_audio::DeviceState;
pub use eddy_background::{Count, Status};
pub use eddy_control::PickupSide;
pub use export::directive_errors;
pub use films::{
    CheckedForm, FilmDone, FilmFacts, FilmField, FilmForm, FilmOrder, FilmPlace, FilmPreset, FilmProgress, FilmStage,
    FilmView, LiveView,
};
pub use options::{DEFAULT_FRAME_LIMIT, SessionError, SessionOptions, frame_limit};
pub use panic_report::{PanicReport, folder as report_folder, home_as_tilde};
pub use pass_history::PassStep;
pub use playback::{Reach, ReplayView, TimeRange};
pub use recent::{KeptBreakpoint, RecentProject};
pub use recovery::{KEPT_DAYS, folder as recovery_folder, place_for_replaced};
pub use sound::SoundView;
pub use state::Session;
pub use trace::TraceView;
pub use tune::{SettingEdit, TuneOptions, TuneOutcome};
pub use view::{
    About, CompileState, FallbackPicture, Halt, Level, Notice, Outcome, TabDiagnostic, TabEdit, TabFix, TabLabel, Tick,
    Transport,
};
