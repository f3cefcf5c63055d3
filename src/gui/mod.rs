//! The window: panels that show a [`Session`](crate::session::Session) and send it commands.
//!
//! Owns the event loop, the surface, the panels, the code editor and the translation of the window system's keys and
//! pointer to the session's commands. Contains no logic that a command line would also need: a panel reads `&Session`
//! and returns commands. Only this module names egui or winit.

mod accessible;
mod actions;
mod app;
mod app_event;
mod back_buffer;
mod browser;
mod buffers;
mod channels;
mod clipboard;
mod code;
mod color_space;
mod compare;
mod config_file;
mod cost_map;
mod costs;
mod custom_uniforms;
mod damage;
mod device_recovery;
mod devices;
mod dialogs;
mod dock;
mod editor;
mod error_map;
mod export_menu;
mod files;
mod flash;
mod focus;
mod fonts;
mod frame;
mod gallery;
mod geometry;
mod halt;
mod help;
mod histogram;
mod hosts;
mod icons;
mod includes;
mod inline_code;
mod input_steps;
mod keys;
mod lab;
mod mapped;
mod measures;
mod menus;
mod palette;
mod panels;
mod passes;
mod picture;
mod probe;
mod problems;
mod questions;
mod recent;
mod recorder;
mod replay;
mod report;
mod resolution;
mod settings;
mod settings_page;
mod shell;
mod sound;
mod sound_bar;
mod speed;
mod surface;
mod surface_faults;
mod system_theme;
mod tabs;
mod termination;
mod theme;
mod thumbnails;
mod timeline;
mod toasts;
mod top_bar;
mod trace;
mod transport;
mod ui_output;
mod uniform_row;
mod uses;
mod value_range;
mod viewport;
mod window_identity;
mod window_opening;

pub use app::{run, run_with};

use crate::{
    gpu::{Gpu, GpuError},
    session::SessionError,
    video::CameraSource,
};
use std::{net::SocketAddr, time::Duration};

/// Called with the first device of a window that has opened.
type Opened = Box<dyn FnOnce(&Gpu)>;

/// The project to open, and how.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The PROJECT of the command line; `None` opens the gallery.
    pub project: Option<String>,
    /// The size inside the window's frame in physical pixels; `None`: a size that suits the screen.
    pub size: Option<(u32, u32)>,
    /// Values for the project's own uniforms, as [`crate::session::EditCommand::AssignCustomUniform`] takes them.
    pub set: Vec<String>,
    /// Show only the picture and the uniforms. The layout of the panels is not saved.
    pub follow: bool,
    /// Do not draw the project until the user starts it.
    pub paused: bool,
    /// A frame that takes longer pauses the picture; `None`: the session's default limit.
    pub frame_limit: Option<Duration>,
    /// The processor time that a driver may take for a large pass; `None`: the session's default limit.
    pub compile_timeout: Option<Duration>,
    /// Report events on standard output, one JSON object a line, for scripts that drive the window.
    pub json: bool,
    /// The camera to use if the user turns one on without choosing one.
    pub webcam: Option<CameraSource>,
    /// Receive OSC on this address, which overrides the settings.
    pub osc: Option<SocketAddr>,
    /// The graphics adapter, as [`AdapterChoice::parse`](crate::gpu::AdapterChoice::parse) takes it. It overrides the
    /// settings.
    pub adapter: Option<String>,
}

/// The window cannot open or cannot continue.
#[derive(Debug, thiserror::Error)]
pub enum GuiError {
    #[error("no display found: {0}. To draw without a display, use `eddy render`")]
    NoDisplay(String),
    /// The device is lost, and with it every picture; `unsaved_work` says what happened to unsaved work.
    #[error("{reason}{unsaved_work}")]
    Lost { reason: GpuError, unsaved_work: String },
    /// The window panicked; `unsaved_work` as above.
    #[error("this is a bug in Eddy: {reason}{unsaved_work}")]
    Panicked { reason: String, unsaved_work: String },
    #[error("cannot draw to the window: {0}")]
    Surface(String),
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Session(#[from] SessionError),
}
