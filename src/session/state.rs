//! [`Session`] itself: its parts, and its construction. Its behaviour is in `apply`, `frames`, `files` and `reload`,
//! and front ends read it through `queries`.

use super::{
    SessionError, SessionOptions,
    analysis::Analyst,
    audio::Audio,
    captures::Captures,
    command::Request,
    compile::Compiler,
    controls::Controls,
    documents::Documents,
    drawing::{self, Drawing, EngineStatus},
    films::Films,
    host::Host,
    last_pictures::LastPictures,
    open_project::OpenProject,
    recent::Recent,
    recovery::UnsavedWork,
    runs::Runs,
    services::{Closing, Display, Services},
    sound::SoundPass,
    view::{About, Level},
};
use eddy_gpu::Gpu;
use std::sync::Arc;

/// An open project over time.
pub struct Session {
    // Before the services in drop order: its searches use the device until they have ended.
    pub(super) open: OpenProject,
    pub(super) services: Services,
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
        let sound_pass = SoundPass::new(drawing::for_background(gpu.clone()), gpu.rasteriser(), wake.clone());
        // An arbitrary size until the first tick, which knows the viewport.
        let size = (640, 360);
        let engine = EngineStatus::new(&gpu, size);
        let drawing = if options.draws_on_thread {
            Drawing::on_thread(gpu.clone(), size, drawing::for_frames(gpu), wake.clone())?
        } else {
            Drawing::inline(gpu, size)?
        };
        let (state_dir, cache_dir) = (options.state_dir.as_deref(), options.cache_dir.as_deref());
        let (recent, forgotten) = Recent::open(state_dir);
        let (recovery, unprotected) = match UnsavedWork::new(options.recovery.clone(), &wake) {
            Ok(recovery) => (recovery, None),
            Err(e) => (UnsavedWork::default(), Some(format!("unsaved work is not protected against a crash: {e}"))),
        };
        let services = Services {
            compiler: Compiler::new(drawing.device(), &options, wake.clone()).map_err(SessionError::Thread)?,
            drawing,
            display: Display::default(),
            captures: Captures::default(),
            analyst: Analyst::new(wake.clone()).map_err(SessionError::Thread)?,
            audio: Audio::new(options.audio.clone(), options.audio_on_thread, state_dir),
            sound_pass,
            controls: Controls::new(&options, wake.clone()),
            films: Films::new(&wake).map_err(SessionError::Thread)?,
            recent,
            runs: Runs::new(state_dir),
            last_pictures: LastPictures::new(cache_dir),
            recovery,
            closing: Closing::default(),
        };
        let open = OpenProject::new(Documents::new(super::template::project()), Host::new(options, wake), engine);
        let mut session = Session { open, services };
        for why in [unprotected, forgotten].into_iter().flatten() {
            session.open.notice_about(About::Window, Level::Warning, why);
        }
        Ok(session)
    }

    /// Takes the oldest pending request to the front end.
    pub fn take_request(&mut self) -> Option<Request> {
        self.open.host.dialog.requests.pop_front()
    }
}
