//! [`Session`] itself: what it is made of, how it starts, and what can be read of it. What it does is in `apply`,
//! `frames`, `files` and `reload`.

use super::{
    analysis::Analyst,
    auditing::Auditing,
    buffers::{BufferRead, Watching},
    clock::Clock,
    command::{Question, Request, Then},
    comparing::{Compared, Comparing, ComparisonView},
    compile,
    costs::{Costs, PassCosts},
    debounce::Debounce,
    documents::Documents,
    drawing::{self, Drawing},
    halting::Halting,
    measuring::Measuring,
    miniatures::Miniatures,
    mouse::Mouse,
    nonfinite::{SearchView, Searching},
    pass_history::PassHistory,
    probe::{ProbeView, Probing},
    recent::{Recent, RecentProject},
    recorder::Recorder,
    recovery::Safekeeping,
    seeking::Seeking,
    tracing::{TraceView, Tracing},
    view::{CompileState, Halt, Level, Notice, TabDiagnostic, Transport},
    watch::Watch,
    worker::Worker,
};
use crate::{
    engine::{BuildOptions, EngineError, Miniature, PassTime, TexelAt},
    gpu::Gpu,
    media::Keyboard,
    project::{CustomUniform, CustomUniformValue, PassId, Project, Tab},
};
use std::{
    collections::VecDeque,
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};

/// How a session is set up. The defaults are what the window uses, but for recovery files.
#[derive(Clone, Debug)]
pub struct SessionOptions {
    /// The longest quiet time after the last keystroke before a compile. It is shorter where compiling is fast, down to
    /// none.
    pub edit_debounce: Duration,
    /// Quiet time after the last change on disk before a reload.
    pub watch_debounce: Duration,
    /// How long files that make no whole project are read again before the user hears of it: an editor may be half way
    /// through writing them.
    pub retry_for: Duration,
    /// The folder for pictures of a project that has none of its own.
    pub pictures: PathBuf,
    /// The user's own copies of the site's stock files.
    pub media_dir: Option<PathBuf>,
    /// The folder for recovery files; `None`: unsaved work ends with the process. The window's is
    /// [`recovery_folder`](super::recovery_folder).
    pub recovery: Option<PathBuf>,
    /// Draw on a thread and a device of their own, so that no tick waits for a frame. Off, each frame is drawn in the
    /// tick that it is due in.
    pub draws_apart: bool,
    /// A frame that is drawn apart and takes longer pauses the picture.
    pub frame_limit: Duration,
    /// The folder for what is remembered between two starts; without, nothing is.
    pub state_dir: Option<PathBuf>,
}

impl Default for SessionOptions {
    fn default() -> Self {
        Self {
            edit_debounce: Duration::from_millis(200),
            watch_debounce: Duration::from_millis(120),
            retry_for: Duration::from_secs(2),
            pictures: dirs::picture_dir().or_else(dirs::home_dir).unwrap_or_else(|| PathBuf::from(".")),
            media_dir: None,
            recovery: None,
            draws_apart: false,
            frame_limit: Duration::from_secs(2),
            state_dir: None,
        }
    }
}

/// The session cannot start.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("no thread for compiling: {0}")]
    Thread(std::io::Error),
    #[error("no thread for drawing: {0}")]
    DrawingThread(std::io::Error),
}

impl From<drawing::Error> for SessionError {
    fn from(error: drawing::Error) -> Self {
        match error {
            drawing::Error::Engine(error) => Self::Engine(error),
            drawing::Error::Thread(error) => Self::DrawingThread(error),
        }
    }
}

/// An open project over time.
pub struct Session {
    pub(super) options: SessionOptions,
    pub(super) wake: Arc<dyn Fn() + Send + Sync>,
    // Before the drawing: its thread uses the device until it has ended.
    pub(super) compiler: Worker<compile::Job, compile::Done>,
    pub(super) analyst: Analyst,
    pub(super) drawing: Drawing,
    pub(super) halting: Halting,
    pub(super) documents: Documents,
    pub(super) canvas: Canvas,
    pub(super) compile: Compile,
    pub(super) disk: Disk,
    pub(super) dialog: Dialog,
    pub(super) safekeeping: Safekeeping,
    pub(super) recent: Recent,
    pub(super) run: Run,
    pub(super) probing: Probing,
    pub(super) tracing: Tracing,
    pub(super) auditing: Auditing,
    /// The first NaN is looked for.
    pub(super) searching: Searching,
    pub(super) comparing: Comparing,
    pub(super) notices: Vec<Notice>,
    pub(super) next_notice: u64,
    pub(super) text_generation: u64,
    pub(super) display_generation: u64,
    pub(super) pictures_shown: u64,
    /// Counts the programs of the newest text that have drawn a frame.
    pub(super) programs_drawn: u64,
    /// A frame was drawn between two ticks.
    pub(super) has_drawn: bool,
    /// Counts the shaders begun by [`Command::New`](super::Command::New).
    pub(super) begun: u64,
    /// Edits of passes and channels.
    pub(super) passes: PassHistory,
    /// Passes that got another name, oldest first.
    pub(super) renamed: Vec<(PassId, PassId)>,
    /// Something a panel shows has changed since the last tick.
    pub(super) changed: bool,
    /// When the newest tick was: the only time there is between ticks.
    pub(super) now: Instant,
}

/// The size that the picture shall have.
pub(super) struct Canvas {
    pub viewport: Option<(u32, u32)>,
    pub scale: f32,
    pub fixed: Option<(u32, u32)>,
    /// The open project asked for that size: it goes with the project.
    pub is_fixed_by_project: bool,
    /// A size the device did not take; not tried again.
    pub refused: Option<(u32, u32)>,
}

/// From texts to the running program.
pub(super) struct Compile {
    pub edits: Debounce,
    /// A text was edited since the last tick.
    pub edited: bool,
    /// Counts the edits after which the texts include other files, and how many of them have been followed by reading.
    pub include_edits: u64,
    pub includes_read: u64,
    /// Compile in the next tick, whatever the debounce says.
    pub is_wanted: bool,
    /// See whether a picture or a model has changed on disk, as soon as the worker has time.
    pub is_look_wanted: bool,
    /// The program under way shall start from zero.
    pub reset_when_built: bool,
    pub state: CompileState,
    pub diagnostics: Vec<TabDiagnostic>,
    /// What reading the project had to say that no compile says.
    pub read: Vec<TabDiagnostic>,
    /// What is to be compiled instead of the newest text.
    pub fallback: Option<Project>,
    /// Since when the worker compiles the newest text, if it does.
    pub newest_since: Option<Instant>,
    pub edited_at: Option<Instant>,
}

/// The project's files.
pub(super) struct Disk {
    pub watch: Option<Watch>,
    pub changes: Debounce,
    /// Look in the next tick, whatever the watch says.
    pub is_check_wanted: bool,
    /// Since when what is on disk makes no whole project.
    pub unsettled_since: Option<Instant>,
    /// The last words about such files, so that they are said once.
    pub told: Option<String>,
    /// `eddy.toml` as it was last read or written.
    pub manifest: Option<Vec<u8>>,
    /// Counts the times a project was opened or took a new place.
    pub opened: u64,
    /// Pictures, models and the files these name, as the last compile found them.
    pub media_files: Vec<PathBuf>,
    pub reset_on_reload: bool,
}

/// Questions to the user and requests to the front end.
#[derive(Default)]
pub(super) struct Dialog {
    pub questions: VecDeque<Question>,
    pub requests: VecDeque<Request>,
    /// The action that goes on after a Save As that a question led to.
    pub after_save: Option<Then>,
}

/// The picture over time.
pub(super) struct Run {
    pub clock: Clock,
    pub mouse: Mouse,
    pub keyboard: Keyboard,
    pub shown: PassId,
    /// A frame must be drawn though time stands still.
    pub is_frame_due: bool,
    /// The newest program has not drawn a frame.
    pub is_program_new: bool,
    pub steps: u32,
    pub seeking: Seeking,
    /// Nobody sees the picture.
    pub is_covered: bool,
    /// The device is gone for good.
    pub is_device_lost: bool,
    pub fps: FpsMeter,
    pub cpu_micros: f64,
    pub costs: Costs,
    pub miniatures: Miniatures,
    pub buffers: Watching,
    pub measuring: Measuring,
    /// The inputs of what is drawn are recorded.
    pub recorder: Option<Recorder>,
}

impl Session {
    /// A session with a new project, playing. `wake` is called from other threads when a tick is worth it (a compile
    /// has ended, a file has changed).
    pub fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Result<Session, SessionError> {
        Self::with_options(gpu, wake, SessionOptions::default())
    }

    pub fn with_options(
        gpu: Gpu,
        wake: Arc<dyn Fn() + Send + Sync>,
        options: SessionOptions,
    ) -> Result<Session, SessionError> {
        // Any size does until the first tick, which knows the viewport.
        let size = (640, 360);
        let drawing = if options.draws_apart {
            Drawing::apart(gpu.clone(), size, drawing::beside(gpu), wake.clone())?
        } else {
            Drawing::here(gpu, size)?
        };
        let work = compile::work(drawing.device(), options.media_dir.clone());
        let compiler = Worker::new("compile", wake.clone(), work).map_err(SessionError::Thread)?;
        let analyst = Analyst::new(wake.clone()).map_err(SessionError::Thread)?;
        let tracing = Tracing::new(wake.clone()).map_err(SessionError::Thread)?;
        let auditing = Auditing::new(wake.clone()).map_err(SessionError::Thread)?;
        let searching = Searching::new(wake.clone()).map_err(SessionError::Thread)?;
        let comparing = Comparing::new(wake.clone()).map_err(SessionError::Thread)?;
        let (recent, forgotten) = Recent::open(options.state_dir.as_deref());
        let mut session = Session {
            wake,
            compiler,
            analyst,
            drawing,
            halting: Halting::new(options.frame_limit, options.state_dir.clone()),
            documents: Documents::new(super::template::project()),
            canvas: Canvas { viewport: None, scale: 1.0, fixed: None, is_fixed_by_project: false, refused: None },
            compile: Compile {
                edits: Debounce::new(options.edit_debounce),
                edited: false,
                include_edits: 0,
                includes_read: 0,
                is_wanted: true,
                is_look_wanted: false,
                reset_when_built: false,
                state: CompileState::default(),
                diagnostics: Vec::new(),
                read: Vec::new(),
                fallback: None,
                newest_since: None,
                edited_at: None,
            },
            disk: Disk {
                watch: None,
                changes: Debounce::with_limit(options.watch_debounce, 8 * options.watch_debounce),
                is_check_wanted: false,
                unsettled_since: None,
                told: None,
                manifest: None,
                opened: 0,
                media_files: Vec::new(),
                reset_on_reload: false,
            },
            dialog: Dialog::default(),
            safekeeping: Safekeeping::default(),
            recent,
            run: Run {
                clock: Clock::default(),
                mouse: Mouse::default(),
                keyboard: Keyboard::default(),
                shown: PassId::Image,
                is_frame_due: false,
                is_program_new: false,
                steps: 0,
                seeking: Seeking::default(),
                is_covered: false,
                is_device_lost: false,
                fps: FpsMeter::default(),
                cpu_micros: 0.0,
                costs: Costs::default(),
                miniatures: Miniatures::default(),
                buffers: Watching::default(),
                measuring: Measuring::default(),
                recorder: None,
            },
            probing: Probing::default(),
            tracing,
            auditing,
            searching,
            comparing,
            notices: Vec::new(),
            next_notice: 0,
            text_generation: 0,
            display_generation: 0,
            pictures_shown: 0,
            programs_drawn: 0,
            has_drawn: false,
            begun: 0,
            passes: PassHistory::default(),
            renamed: Vec::new(),
            changed: true,
            now: Instant::now(),
            options,
        };
        match Safekeeping::new(session.options.recovery.clone(), &session.wake) {
            Ok(safekeeping) => session.safekeeping = safekeeping,
            Err(e) => session.notice(Level::Warning, format!("unsaved work is not safe from a crash: {e}")),
        }
        if let Some(why) = forgotten {
            session.notice(Level::Warning, why);
        }
        session.compile.state.compiling = true;
        Ok(session)
    }

    /// The newest picture of the shown pass: rgba8unorm, its first row the top, values as display values. Ask anew
    /// after each tick: a resize makes another one.
    pub fn display(&self) -> &wgpu::TextureView {
        self.drawing.display()
    }

    /// Grows whenever [`Session::display`] may have become another texture.
    pub fn display_generation(&self) -> u64 {
        self.display_generation
    }

    /// The device that shows the picture.
    pub fn gpu(&self) -> &Gpu {
        self.drawing.gpu()
    }

    pub fn project(&self) -> &Project {
        self.documents.current()
    }

    /// Every tab in the site's order.
    pub fn tabs(&self) -> Vec<Tab> {
        self.project().tabs()
    }

    /// A tab's text; empty for a tab there is not.
    pub fn text(&self, tab: &Tab) -> &str {
        self.project().source(tab).map_or("", |s| &s.text)
    }

    /// Grows whenever a text was changed by something else than [`Command::EditText`] (opened, reloaded, taken from
    /// disk): then an editor must take it anew.
    /// Returns how many programs have drawn a frame so far, each of the text that was the newest: it grows when an edit
    /// is in the picture.
    pub fn programs_drawn(&self) -> u64 {
        self.programs_drawn
    }

    /// Returns how long typing has to rest before it is compiled.
    pub fn edit_debounce(&self) -> Duration {
        self.compile.edits.quiet()
    }

    pub fn text_generation(&self) -> u64 {
        self.text_generation
    }

    /// The projects that were open before, the newest first; those that are gone meanwhile too.
    pub fn recent(&self) -> &[RecentProject] {
        self.recent.list()
    }

    /// Counts the shaders that were begun by [`Command::New`](super::Command::New).
    pub fn begun(&self) -> u64 {
        self.begun
    }

    /// Counts the times that a project was opened or took a new place.
    pub fn opened(&self) -> u64 {
        self.disk.opened
    }

    /// The author's own uniforms, as the running program declares them.
    pub fn custom_uniforms(&self) -> &[CustomUniform] {
        self.drawing.custom_uniforms()
    }

    /// Returns where one of them stands.
    pub fn custom_uniform_value(&self, custom_uniform: &CustomUniform) -> CustomUniformValue {
        custom_uniform.value(&self.project().custom_uniform_values)
    }

    /// The tab's text differs from the one on disk.
    pub fn is_tab_dirty(&self, tab: &Tab) -> bool {
        self.documents.is_tab_dirty(tab)
    }

    /// Anything at all differs from what is on disk: texts, passes, channels.
    pub fn is_dirty(&self) -> bool {
        self.documents.is_dirty()
    }

    /// Returns the diagnostics of the newest finished compile for all tabs, errors first.
    pub fn diagnostics(&self) -> &[TabDiagnostic] {
        &self.compile.diagnostics
    }

    pub fn compile_state(&self) -> &CompileState {
        &self.compile.state
    }

    pub fn transport(&self) -> Transport {
        let times = self.pass_times();
        let playing = self.run.clock.is_playing() || self.run.seeking.resumes;
        Transport {
            playing,
            time_secs: self.run.clock.time_secs(),
            frame: (self.run.clock.next_frame_number() - 1).max(0),
            fps: Some(self.run.fps.fps).filter(|fps| playing && *fps > 0.0),
            gpu_millis: (playing && !times.is_empty()).then(|| times.iter().map(|t| t.gpu_millis).sum()),
            cpu_micros: playing.then_some(self.run.cpu_micros),
            resolution: self.drawing.size(),
            scale: self.canvas.scale,
            fixed_size: self.canvas.fixed,
            speed: self.run.clock.speed(),
            fixed_rate: self.run.clock.fixed_rate(),
            is_seeking: self.run.seeking.is_seeking(),
        }
    }

    /// Device time of each pass, of the newest frame the device has finished; empty where it cannot tell.
    pub fn pass_times(&self) -> &[PassTime] {
        self.run.costs.newest()
    }

    /// Returns what each pass of the running program costs, in drawing order, then those that are not drawn. They are
    /// gathered once [`Command::WatchCosts`] has been given; milliseconds are there when a frame was drawn since.
    pub fn pass_costs(&self) -> PassCosts {
        self.run.costs.of(self.drawing.costs().to_vec(), self.drawing.clock())
    }

    /// Returns a small picture of one of a pass's targets, while it is watched
    /// ([`Command::WatchTargets`](super::Command::WatchTargets)), and a number that grows with each new one.
    pub fn miniature(&self, pass: &PassId, index: usize) -> Option<(&Miniature, u64)> {
        self.run.miniatures.get(pass, index)
    }

    /// Returns the target that is looked at closely ([`Command::WatchBuffers`](super::Command::WatchBuffers)), and a
    /// number that grows with each new one.
    pub fn buffer(&self) -> Option<(&Arc<BufferRead>, u64)> {
        self.run.buffers.shown()
    }

    /// Returns the texel of each target at the place that is looked at.
    pub fn texels_under(&self) -> &[TexelAt] {
        self.run.buffers.under()
    }

    /// The search for the first NaN ([`Command::FindNonfinite`](super::Command::FindNonfinite)).
    pub fn search(&self) -> SearchView<'_> {
        self.searching.view()
    }

    /// The comparison with another project ([`Command::Compare`](super::Command::Compare)).
    pub fn comparison(&self) -> ComparisonView<'_> {
        self.comparing.view()
    }

    /// The newest comparison is not of the project as it stands now.
    pub fn is_comparison_old(&self) -> bool {
        matches!(self.comparing.view(), Some(Compared::Ended(Ok(done))) if done.revision != self.documents.revision())
    }

    /// What is drawn instead of the picture, while somebody has asked for it: see
    /// [`Command::Probe`](super::Command::Probe).
    pub fn probe(&self) -> Option<ProbeView<'_>> {
        self.probing.view()
    }

    /// The pixel that is traced ([`Command::Trace`](super::Command::Trace)).
    pub fn trace(&self) -> TraceView<'_> {
        self.tracing.view()
    }

    /// What the display shows: the shown pass, or a value of the code.
    pub(super) fn pictured(&self) -> PassId {
        if self.probing.is_drawn() { BuildOptions::probed() } else { self.run.shown.clone() }
    }

    pub fn shown_pass(&self) -> &PassId {
        &self.run.shown
    }

    pub fn reset_on_reload(&self) -> bool {
        self.disk.reset_on_reload
    }

    /// Oldest first; stay until dismissed.
    pub fn notices(&self) -> &[Notice] {
        &self.notices
    }

    /// Returns why the picture stands still though nobody has paused it.
    pub fn halt(&self) -> Option<&Halt> {
        self.halting.halt.as_ref()
    }

    /// Returns whether there is code to go back to.
    pub fn has_last_good(&self) -> bool {
        self.halting.good.is_some()
    }

    /// Returns what must be answered before anything else.
    pub fn question(&self) -> Option<&Question> {
        self.dialog.questions.front()
    }

    pub fn take_request(&mut self) -> Option<Request> {
        self.dialog.requests.pop_front()
    }

    pub(super) fn notice(&mut self, level: Level, text: impl Into<String>) {
        let text = text.into();
        log::log!(
            match level {
                Level::Info => log::Level::Info,
                Level::Warning => log::Level::Warn,
                Level::Error => log::Level::Error,
            },
            "{text}"
        );
        self.notices.push(Notice { id: self.next_notice, level, text, path: None, undoes: None, at: self.now });
        self.next_notice += 1;
        self.changed = true;
    }
}

/// Frames a second as people read it: over half a second, as the site shows it.
#[derive(Default)]
pub(super) struct FpsMeter {
    pub fps: f64,
    window: Option<(Instant, u32)>,
}

impl FpsMeter {
    /// A frame was drawn while playing. True if the figure has changed.
    pub fn frame(&mut self, now: Instant) -> bool {
        let (since, frames) = self.window.get_or_insert((now, 0));
        let elapsed = now.saturating_duration_since(*since);
        let full = elapsed >= Duration::from_millis(500);
        if full {
            self.fps = f64::from(*frames) / elapsed.as_secs_f64();
            (*since, *frames) = (now, 0);
        }
        *frames += 1;
        full
    }

    /// Frames after a pause are not measured against those before it, and what was measured is of another time.
    pub fn restart(&mut self) {
        (self.fps, self.window) = (0.0, None);
    }
}
