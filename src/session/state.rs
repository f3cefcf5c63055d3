//! [`Session`] itself: its parts, and its construction. Its behaviour is in `apply`, `frames`, `files` and `reload`,
//! and front ends read it through `queries`.

use super::{
    SessionError, SessionOptions,
    analysis::Analyst,
    audio::Audio,
    audit::Auditing,
    canvas::Canvas,
    command::{PendingAction, Question, Request},
    compare::Comparing,
    compile::CompileControl,
    controls::Controls,
    devices::Devices,
    disk::DiskSync,
    documents::Documents,
    drawing::{self, Drawing},
    films::Films,
    halt::HaltControl,
    last_pictures::LastPictures,
    nonfinite::Searching,
    notices::Notices,
    pass_history::PassHistory,
    playback::Playback,
    read_back::ReadBacks,
    recent::Recent,
    recovery::UnsavedWork,
    runs::Runs,
    sound::Sounding,
    trace::Tracing,
    uniforms::TextUniforms,
    view::{About, Level},
};
use eddy_gpu::Gpu;
use eddy_project::PassName;
use std::{collections::VecDeque, sync::Arc, time::Instant};

/// An open project over time.
pub struct Session {
    pub(super) options: SessionOptions,
    pub(super) wake: Arc<dyn Fn() + Send + Sync>,
    // Before the drawing in drop order: its thread uses the device until it has ended.
    pub(super) compile: CompileControl,
    pub(super) analyst: Analyst,
    pub(super) drawing: Drawing,
    pub(super) halting: HaltControl,
    pub(super) documents: Documents,
    pub(super) canvas: Canvas,
    pub(super) uniforms: TextUniforms,
    pub(super) disk: DiskSync,
    pub(super) dialog: Dialog,
    pub(super) unsaved: UnsavedWork,
    pub(super) recent: Recent,
    pub(super) runs: Runs,
    pub(super) last_pictures: LastPictures,
    pub(super) playback: Playback,
    pub(super) devices: Devices,
    pub(super) audio: Audio,
    pub(super) controls: Controls,
    pub(super) picture: Picture,
    pub(super) watched: ReadBacks,
    pub(super) tracing: Tracing,
    pub(super) auditing: Auditing,
    /// The search for the first NaN.
    pub(super) searching: Searching,
    pub(super) comparing: Comparing,
    pub(super) films: Films,
    pub(super) sounding: Sounding,
    pub(super) notices: Notices,
    /// Counts the projects that have replaced another.
    pub(super) projects_opened: u64,
    pub(super) text_generation: u64,
    /// Counts the shaders created by [`Command::New`](super::Command::New).
    pub(super) begun: u64,
    /// The history of edits of passes and channels.
    pub(super) passes: PassHistory,
    /// Passes that were renamed, oldest first.
    pub(super) renamed: Vec<(PassName, PassName)>,
    /// Something that a panel shows has changed since the last tick.
    pub(super) changed: bool,
    /// The time of the newest tick, which is the current time until the next one.
    pub(super) now: Instant,
}

/// Questions to the user and requests to the front end.
#[derive(Default)]
pub(super) struct Dialog {
    pub questions: VecDeque<Question>,
    pub requests: VecDeque<Request>,
    /// The action that follows a Save As that a question led to.
    pub after_save: Option<PendingAction>,
}

/// The state of the shown picture.
#[derive(Default)]
pub(super) struct Picture {
    pub shown: PassName,
    /// The newest program has not drawn a frame.
    pub is_program_new: bool,
    /// There is a new picture, to be painted before another is drawn.
    pub is_new: bool,
    /// The next frame is submitted after that was painted.
    pub waits_for_painting: bool,
    /// A frame was drawn between two ticks.
    pub has_drawn: bool,
    /// Grows with each new texture, and with each new picture in it.
    pub generation: u64,
    pub shown_count: u64,
    /// Counts the programs of the newest text that have drawn a frame.
    pub programs_drawn: u64,
    /// Counts the pictures of frames that the engine has drawn.
    pub frames_drawn: u64,
}

impl Session {
    /// Creates a session with a new project, playing. `wake` is called from other threads when a tick is needed (a
    /// compile has finished, a file has changed).
    pub fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Result<Session, SessionError> {
        Self::with_options(gpu, wake, SessionOptions::default())
    }

    pub fn with_options(
        gpu: Gpu,
        wake: Arc<dyn Fn() + Send + Sync>,
        options: SessionOptions,
    ) -> Result<Session, SessionError> {
        let sounding = Sounding::new(drawing::beside(gpu.clone()), gpu.is_cpu(), wake.clone());
        // An arbitrary size until the first tick, which knows the viewport.
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
        let films = Films::new(&wake).map_err(SessionError::Thread)?;
        let (recent, forgotten) = Recent::open(options.state_dir.as_deref());
        let mut session = Session {
            analyst,
            drawing,
            halting: HaltControl::new(options.frame_limit, options.state_dir.as_deref()),
            documents: Documents::new(super::template::project()),
            canvas: Canvas::default(),
            compile,
            uniforms: TextUniforms::default(),
            disk: DiskSync::new(&options),
            dialog: Dialog::default(),
            unsaved: UnsavedWork::default(),
            recent,
            runs: Runs::new(options.state_dir.as_deref()),
            last_pictures: LastPictures::new(options.cache_dir.as_deref()),
            playback: Playback::default(),
            devices: Devices::default(),
            audio: Audio::new(options.audio.clone(), options.audio_on_thread, options.state_dir.as_deref()),
            controls: Controls::new(&options, wake.clone()),
            picture: Picture::default(),
            watched: ReadBacks::default(),
            tracing,
            auditing,
            searching,
            comparing,
            films,
            sounding,
            notices: Notices::default(),
            projects_opened: 0,
            text_generation: 0,
            begun: 0,
            passes: PassHistory::default(),
            renamed: Vec::new(),
            changed: true,
            now: Instant::now(),
            wake,
            options,
        };
        match UnsavedWork::new(session.options.recovery.clone(), &session.wake) {
            Ok(unsaved) => session.unsaved = unsaved,
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

    /// Takes the oldest pending request to the front end.
    pub fn take_request(&mut self) -> Option<Request> {
        self.dialog.requests.pop_front()
    }
}
