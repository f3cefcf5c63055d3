//! [`Session`] itself: its parts, and how it starts. What it does is in `apply`, `frames`, `files` and `reload`, and
//! front ends read it by `queries`.

use super::{
    SessionError, SessionOptions,
    analysis::Analyst,
    audit::Auditing,
    buffers::Watching,
    captures::Captures,
    command::{PendingAction, Question, Request},
    compare::Comparing,
    compile::CompileControl,
    costs::Costs,
    disk::DiskSync,
    documents::Documents,
    drawing::{self, Drawing},
    halt::HaltControl,
    last_pictures::LastPictures,
    measuring::Measuring,
    miniatures::Miniatures,
    nonfinite::Searching,
    pass_history::PassHistory,
    playback::Playback,
    probe::Probing,
    recent::Recent,
    recovery::Safekeeping,
    runs::Runs,
    trace::Tracing,
    uniforms_of_texts::{DeclaredUniforms, RenamedUniforms},
    view::{About, Level, Notice},
};
use eddy_gpu::Gpu;
use eddy_project::PassId;
use std::{collections::VecDeque, sync::Arc, time::Instant};

/// An open project over time.
pub struct Session {
    pub(super) options: SessionOptions,
    pub(super) wake: Arc<dyn Fn() + Send + Sync>,
    // Before the drawing: its thread uses the device until it has ended.
    pub(super) compile: CompileControl,
    pub(super) analyst: Analyst,
    pub(super) drawing: Drawing,
    pub(super) halting: HaltControl,
    pub(super) documents: Documents,
    pub(super) canvas: Canvas,
    /// Uniforms that have another name in the texts than in the program that draws.
    pub(super) renamed_uniforms: RenamedUniforms,
    pub(super) declared_uniforms: DeclaredUniforms,
    pub(super) disk: DiskSync,
    pub(super) dialog: Dialog,
    pub(super) safekeeping: Safekeeping,
    pub(super) recent: Recent,
    pub(super) runs: Runs,
    pub(super) last_pictures: LastPictures,
    pub(super) captures: Captures,
    pub(super) playback: Playback,
    pub(super) run: Run,
    pub(super) probing: Probing,
    pub(super) tracing: Tracing,
    pub(super) auditing: Auditing,
    /// The first NaN is looked for.
    pub(super) searching: Searching,
    pub(super) comparing: Comparing,
    pub(super) notices: Vec<Notice>,
    pub(super) next_notice: u64,
    /// The number of the next notice when the command under way began.
    pub(super) command_began: u64,
    /// Counts the projects that have taken the place of another.
    pub(super) projects_opened: u64,
    pub(super) text_generation: u64,
    pub(super) display_generation: u64,
    pub(super) pictures_shown: u64,
    /// Counts the programs of the newest text that have drawn a frame.
    pub(super) programs_drawn: u64,
    /// Counts the pictures of frames that the engine has drawn.
    pub(super) frames_drawn: u64,
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
    /// The time of the newest tick: the only time there is between ticks.
    pub(super) now: Instant,
}

/// The size that the picture shall have.
pub(super) struct Canvas {
    pub viewport: Option<(u32, u32)>,
    pub asked: CanvasSize,
    /// The size that was asked for before any project was opened: each begins with it.
    pub usual: CanvasSize,
    /// The size of a recording that is played, or was until now.
    pub replayed: Option<(u32, u32)>,
    /// A size the device did not take; not tried again.
    pub refused: Option<(u32, u32)>,
}

/// The size that a person has asked for, for the open project.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CanvasSize {
    /// Canvas pixels to viewport pixels.
    pub scale: f32,
    pub fixed: Option<(u32, u32)>,
}

impl Default for CanvasSize {
    fn default() -> Self {
        Self { scale: 1.0, fixed: None }
    }
}

/// Questions to the user and requests to the front end.
#[derive(Default)]
pub(super) struct Dialog {
    pub questions: VecDeque<Question>,
    pub requests: VecDeque<Request>,
    /// The action that goes on after a Save As that a question led to.
    pub after_save: Option<PendingAction>,
}

/// The picture that is shown, and what is read of it.
pub(super) struct Run {
    pub shown: PassId,
    /// The newest program has not drawn a frame.
    pub is_program_new: bool,
    /// There is a new picture, to be painted before another is drawn.
    pub is_picture_new: bool,
    /// The next frame is handed in when that has been painted.
    pub waits_for_painting: bool,
    pub cpu_micros: f64,
    pub costs: Costs,
    pub miniatures: Miniatures,
    pub buffers: Watching,
    pub measuring: Measuring,
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
        let drawing = if options.draws_on_thread {
            Drawing::on_thread(gpu.clone(), size, drawing::beside(gpu), wake.clone())?
        } else {
            Drawing::inline(gpu, size)?
        };
        let compile = CompileControl::new(drawing.device(), &options, wake.clone()).map_err(SessionError::Thread)?;
        let analyst = Analyst::new(wake.clone()).map_err(SessionError::Thread)?;
        let tracing = Tracing::new(wake.clone()).map_err(SessionError::Thread)?;
        let auditing = Auditing::new(wake.clone()).map_err(SessionError::Thread)?;
        let searching = Searching::new(wake.clone()).map_err(SessionError::Thread)?;
        let comparing = Comparing::new(wake.clone()).map_err(SessionError::Thread)?;
        let (recent, forgotten) = Recent::open(options.state_dir.as_deref());
        let mut session = Session {
            wake,
            analyst,
            drawing,
            halting: HaltControl::new(options.frame_limit, options.state_dir.as_deref()),
            documents: Documents::new(super::template::project()),
            canvas: Canvas {
                viewport: None,
                asked: CanvasSize::default(),
                usual: CanvasSize::default(),
                replayed: None,
                refused: None,
            },
            compile,
            renamed_uniforms: RenamedUniforms::new(),
            declared_uniforms: DeclaredUniforms::default(),
            disk: DiskSync::new(&options),
            dialog: Dialog::default(),
            safekeeping: Safekeeping::default(),
            recent,
            runs: Runs::new(options.state_dir.as_deref()),
            last_pictures: LastPictures::new(options.cache_dir.as_deref()),
            captures: Captures::default(),
            playback: Playback::default(),
            run: Run {
                shown: PassId::Image,
                is_program_new: false,
                is_picture_new: false,
                waits_for_painting: false,
                cpu_micros: 0.0,
                costs: Costs::default(),
                miniatures: Miniatures::default(),
                buffers: Watching::default(),
                measuring: Measuring::default(),
            },
            probing: Probing::default(),
            tracing,
            auditing,
            searching,
            comparing,
            notices: Vec::new(),
            next_notice: 0,
            command_began: 0,
            projects_opened: 0,
            text_generation: 0,
            display_generation: 0,
            pictures_shown: 0,
            programs_drawn: 0,
            frames_drawn: 0,
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
            Err(e) => session.notice_about(
                About::Window,
                Level::Warning,
                format!("unsaved work is not protected against a crash: {e}"),
            ),
        }
        if let Some(why) = forgotten {
            session.notice_about(About::Window, Level::Warning, why);
        }
        Ok(session)
    }

    /// Takes the oldest thing that the front end is asked to do.
    pub fn take_request(&mut self) -> Option<Request> {
        self.dialog.requests.pop_front()
    }
}
