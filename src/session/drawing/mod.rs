//! The connection from the session to the engine: jobs go out, pictures and measurements come back.
//!
//! Owns the engine, which draws synchronously, or on a thread: on a GPU with the window's device, else with one of its
//! own. It gets one job at a time. Requests that arrive meanwhile wait here, and a newer one of a kind replaces the
//! older: no queue builds up, and nothing blocks on a frame. Knows nothing of texts, time or messages to the user.

mod changes;
mod gate;
mod history;
mod job;
mod render_thread;
mod renderer;
mod status;
mod task;

pub(super) use changes::{Change, PendingChanges, PendingProgram, ProgramOrigin};
pub(super) use gate::FrameControl;
pub(super) use history::SeekProgress;
pub(super) use job::{Draw, DrawnFrame, Event, Job, JobResult, TileLimit};
pub(super) use render_thread::{Device, Open, for_background, for_frames};
pub(super) use renderer::{Renderer, ShownPicture};
pub(super) use status::EngineStatus;
pub(super) use task::{Finished, RenderTask, Tasks, Ticket};

use eddy_engine::EngineError;
use eddy_gpu::{Gpu, GpuError, Presenter, Texture};
use eddy_playback::run::Frame;
use gate::Gate;
use render_thread::RenderThread;
use renderer::Delivery;
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// A job is waited for this long if the previous one was faster: a picture that is drawn quickly appears in the frame
/// that requests it.
const FAST_JOB: Duration = Duration::from_millis(4);

/// The engine, on this thread or another.
pub(super) struct Drawing {
    backend: Backend,
    /// The number of the open project. A result with another number belongs to the previous one.
    serial: u64,
    in_flight: Option<InFlight>,
    /// Threads that were abandoned and may still be running.
    abandoned: Vec<JoinHandle<()>>,
    /// The bytes of pictures that were read from one device and written to another.
    copied_bytes: u64,
    /// The device that draws and paints is lost, and the window has no other yet.
    lost: Option<Loss>,
}

/// The loss of a device.
pub(super) struct Loss {
    pub why: String,
    pub shown: ShownFrame,
}

/// The data from which another device shows the same frame.
pub(super) enum ShownFrame {
    /// The time of a project without state.
    Time { secs: f64, frame: i32 },
    /// The inputs of all frames since the reset; empty if they are not known.
    Run(Vec<Frame>),
}

struct InFlight {
    since: Instant,
    /// The number of the job's project.
    serial: u64,
    /// The thread opens its device; no code of the author runs yet.
    is_opening: bool,
}

enum Backend {
    Inline { renderer: Box<Renderer>, device: Device, done: Option<JobResult> },
    RenderThread(Box<ThreadBackend>),
}

/// An engine on another thread, and its newest picture on the window's device.
struct ThreadBackend {
    thread: RenderThread,
    device: Device,
    /// Controls a frame that may wait.
    gate: Gate,
    open: Open,
    wake: Arc<dyn Fn() + Send + Sync>,
    window: Gpu,
    display: Display,
    /// Ends the frame that is being drawn, if the thread is abandoned.
    stop: Arc<AtomicBool>,
    /// The duration of the newest job on its thread.
    took: Duration,
}

/// The picture that the window shows.
enum Display {
    /// A copy of the engine's, on the window's device.
    Copy(Box<Texture>),
    /// The engine's, with its size.
    Engine(wgpu::TextureView, (u32, u32)),
}

impl Display {
    fn view(&self) -> &wgpu::TextureView {
        match self {
            Display::Copy(texture) => &texture.level_0,
            Display::Engine(view, _) => view,
        }
    }

    fn size(&self) -> (u32, u32) {
        match self {
            Display::Copy(texture) => (texture.width(), texture.height()),
            Display::Engine(_, size) => *size,
        }
    }
}

impl Drawing {
    /// An engine that does each job synchronously.
    pub(crate) fn inline(gpu: Gpu, size: (u32, u32)) -> Result<Self, EngineError> {
        let renderer = Box::new(Renderer::new(gpu.clone(), size, Delivery::Inline, Arc::default())?);
        let device = Device::open(gpu);
        Ok(Self::new(Backend::Inline { renderer, device, done: None }))
    }

    /// An engine on a thread of its own, with the device that `open` returns.
    pub(crate) fn on_thread(
        window: Gpu,
        size: (u32, u32),
        open: Open,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> Result<Self, Error> {
        let device = Device::default();
        let stop = Arc::default();
        let (rasteriser, woken) = (window.rasteriser(), wake.clone());
        let thread = RenderThread::start(open.clone(), device.clone(), size, Arc::clone(&stop), rasteriser, woken)?;
        let texture = Presenter::texture(&window, size.0, size.1).map_err(EngineError::from)?;
        let display = Display::Copy(Box::new(texture));
        let (gate, took) = (Gate::default(), Duration::MAX);
        let remote = ThreadBackend { thread, device, gate, open, wake, window, display, stop, took };
        let mut drawing = Self::new(Backend::RenderThread(Box::new(remote)));
        drawing.in_flight = Some(InFlight::opening(Instant::now(), 0));
        Ok(drawing)
    }

    fn new(backend: Backend) -> Self {
        Self { backend, serial: 0, in_flight: None, abandoned: Vec::new(), copied_bytes: 0, lost: None }
    }

    /// Returns whether frames are drawn by the processor that also paints the window.
    pub(crate) fn shares_processor(&self) -> bool {
        matches!(&self.backend, Backend::RenderThread(remote) if remote.window.rasteriser().shares_processor())
    }

    /// Returns whether the window is painted on the device that draws.
    pub(crate) fn shares_window_device(&self) -> bool {
        matches!(&self.backend, Backend::RenderThread(remote) if !remote.window.rasteriser().shares_processor())
    }

    /// Returns the bytes of pictures that were read from one device and written to another so far.
    pub(crate) fn copied_bytes(&self) -> u64 {
        self.copied_bytes
    }

    /// Records why the device that draws and paints is lost, until [`Drawing::show_on`]. Returns whether that is new.
    pub(crate) fn lose_window_device(&mut self, why: &str) -> bool {
        let is_new = self.lost.is_none();
        self.lost.get_or_insert_with(|| Loss { why: why.to_owned(), shown: ShownFrame::Run(Vec::new()) });
        is_new
    }

    /// Sets the frame that the device showed before it was lost.
    pub(crate) fn keep_shown(&mut self, shown: ShownFrame) {
        if let Some(loss) = &mut self.lost {
            loss.shown = shown;
        }
    }

    pub(crate) fn is_on_thread(&self) -> bool {
        matches!(self.backend, Backend::RenderThread(_))
    }

    /// The device that shows the picture.
    pub(crate) fn gpu(&self) -> &Gpu {
        match &self.backend {
            Backend::Inline { renderer, .. } => renderer.engine().gpu(),
            Backend::RenderThread(remote) => &remote.window,
        }
    }

    /// The device that draws, once it is open.
    pub(crate) fn device(&self) -> Device {
        match &self.backend {
            Backend::Inline { device, .. } => device.clone(),
            Backend::RenderThread(remote) => remote.device.clone(),
        }
    }

    /// The newest picture, with its first row at the top.
    pub(crate) fn display(&self) -> &wgpu::TextureView {
        match &self.backend {
            Backend::Inline { renderer, .. } => renderer.engine().display(),
            Backend::RenderThread(remote) => remote.display.view(),
        }
    }

    /// Returns whether the engine has a job: no other can be submitted.
    pub(crate) fn is_busy(&self) -> bool {
        self.in_flight.is_some()
    }

    /// The time since which the engine has been drawing, if it is.
    pub(crate) fn draws_since(&self) -> Option<Instant> {
        self.in_flight.as_ref().filter(|job| !job.is_opening).map(|job| job.since)
    }

    /// Switches to the project with this number. Returns whether the engine must be restarted: one that is being opened
    /// is new already.
    pub(crate) fn switch_project(&mut self, serial: u64) -> bool {
        self.serial = serial;
        match &mut self.in_flight {
            Some(job) if job.is_opening => {
                job.serial = serial;
                false
            }
            _ => true,
        }
    }

    /// Controls the frame that is being drawn, if it may wait.
    pub(crate) fn set_frame_control(&self, control: FrameControl) {
        if let Backend::RenderThread(remote) = &self.backend {
            remote.gate.set(control);
        }
    }

    /// Returns the current control of the frame that is being drawn.
    #[cfg(test)]
    pub(crate) fn frame_control(&self) -> Option<FrameControl> {
        match &self.backend {
            Backend::Inline { .. } => None,
            Backend::RenderThread(remote) => Some(remote.gate.get()),
        }
    }

    /// Submits a job. The engine must be idle. With `may_wait` its frame follows [`Drawing::set_frame_control`].
    pub(crate) fn submit(&mut self, now: Instant, may_wait: bool, mut job: Job) {
        if let Backend::RenderThread(remote) = &self.backend {
            remote.gate.set(FrameControl::Continue);
            job.gate = may_wait.then(|| remote.gate.clone());
        }
        self.in_flight = Some(InFlight { since: now, serial: self.serial, is_opening: false });
        match &mut self.backend {
            Backend::Inline { renderer, done, .. } => *done = Some(renderer.work(job)),
            Backend::RenderThread(remote) => remote.thread.submit(job),
        }
    }

    /// Returns the result of the job, once, or the reason why the engine's thread has ended, and whether that is of the
    /// open project. Waits for a moment if the last job was that fast.
    pub(crate) fn take(&mut self, was_just_submitted: bool) -> Option<(Result<JobResult, String>, bool)> {
        self.in_flight.as_ref()?;
        let mut done = match &mut self.backend {
            Backend::Inline { done, .. } => done.take().map(Ok),
            Backend::RenderThread(remote) => {
                let waits = was_just_submitted && remote.took < FAST_JOB;
                remote.thread.take(if waits { FAST_JOB } else { Duration::ZERO })
            }
        }?;
        let job = self.in_flight.take()?;
        if let Ok(done) = &mut done {
            if let Backend::RenderThread(remote) = &mut self.backend {
                remote.took = done.took;
            }
            // Outputs for a project that was closed have no ticket any longer.
            done.outputs.drain(..).for_each(|deliver| deliver());
        }
        Some((done, job.serial == self.serial))
    }

    /// Shows a picture of the engine. Returns whether the display is a different texture now.
    pub(crate) fn show(&mut self, picture: ShownPicture) -> Result<bool, GpuError> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(false) };
        match picture {
            ShownPicture::Texture { view, size } => {
                let is_new = *remote.display.view() != view;
                remote.display = Display::Engine(view, size);
                Ok(is_new)
            }
            ShownPicture::Bytes(picture) => {
                let size = (picture.width, picture.height);
                self.copied_bytes += 2 * picture.bytes.len() as u64;
                if let Display::Copy(display) = &remote.display
                    && remote.display.size() == size
                {
                    display.write(&remote.window, &picture.bytes);
                    return Ok(false);
                }
                let display = Presenter::texture(&remote.window, size.0, size.1)?;
                display.write(&remote.window, &picture.bytes);
                remote.display = Display::Copy(Box::new(display));
                Ok(true)
            }
        }
    }

    /// Shows the picture on a new device, as the previous one is lost. There is no picture until one is delivered.
    /// Returns the loss if the engine has lost its device with it, and must be restarted.
    pub(crate) fn show_on(&mut self, window: Gpu) -> Result<Option<Loss>, GpuError> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(None) };
        let (width, height) = remote.display.size();
        remote.display = Display::Copy(Box::new(Presenter::texture(&window, width, height)?));
        (remote.window, remote.open) = (window.clone(), for_frames(window));
        Ok(self.lost.take())
    }

    /// Abandons the thread and its device, and starts new ones. The picture stays until there is another.
    pub(crate) fn restart_thread(&mut self, now: Instant, size: (u32, u32)) -> std::io::Result<()> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(()) };
        let device = Device::default();
        let stop = Arc::default();
        let ThreadBackend { open, wake, window, .. } = &**remote;
        let (rasteriser, wake) = (window.rasteriser(), wake.clone());
        let thread = RenderThread::start(open.clone(), device.clone(), size, Arc::clone(&stop), rasteriser, wake)?;
        std::mem::replace(&mut remote.stop, stop).store(true, Ordering::Relaxed);
        (remote.device, remote.gate, remote.took) = (device, Gate::default(), Duration::MAX);
        self.abandoned.extend(std::mem::replace(&mut remote.thread, thread).leave());
        self.in_flight = Some(InFlight::opening(now, self.serial));
        Ok(())
    }

    /// The number of abandoned threads that have not ended.
    pub(crate) fn lost_threads(&mut self) -> usize {
        self.abandoned.retain(|thread| !thread.is_finished());
        self.abandoned.len()
    }

    /// Waits for the end of the job, up to `patience`. Returns false if it is still running.
    pub(crate) fn wait_idle(&mut self, patience: Duration) -> bool {
        let end = Instant::now() + patience;
        while self.is_busy() && self.take(false).is_none() {
            if Instant::now() >= end {
                return false;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        true
    }

    /// Ends an idle engine.
    pub(crate) fn close(&mut self) {
        if let Backend::RenderThread(remote) = &mut self.backend {
            remote.thread.end();
        }
    }
}

impl InFlight {
    fn opening(since: Instant, serial: u64) -> Self {
        Self { since, serial, is_opening: true }
    }
}

/// The engine does not exist.
#[derive(Debug, thiserror::Error)]
pub(super) enum Error {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("cannot start a thread for drawing: {0}")]
    Thread(#[from] std::io::Error),
}

#[cfg(test)]
mod tests;
