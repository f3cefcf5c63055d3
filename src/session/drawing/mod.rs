//! The connection from the session to the engine: jobs go out, pictures and measurements come back.
//!
//! Owns the engine, which draws synchronously, or on a thread and a device of its own. It gets one job at a time.
//! Requests that arrive meanwhile wait here, and a newer one of a kind replaces the older: no queue builds up, and
//! nothing blocks on a frame. Knows nothing of texts, time or messages to the user.

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
pub(super) use render_thread::{Device, Open, beside};
pub(super) use renderer::Renderer;
pub(super) use status::EngineStatus;
pub(super) use task::{Finished, RenderTask, Tasks, Ticket};

use eddy_engine::{EngineError, Picture};
use eddy_gpu::{Gpu, GpuError, Presenter, Texture};
use gate::Gate;
use render_thread::RenderThread;
use std::{
    sync::Arc,
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
    display: Texture,
    /// The duration of the newest job on its thread.
    took: Duration,
}

impl Drawing {
    /// An engine that does each job synchronously.
    pub(crate) fn inline(gpu: Gpu, size: (u32, u32)) -> Result<Self, EngineError> {
        let (renderer, device) = (Box::new(Renderer::new(gpu.clone(), size, false)?), Device::open(gpu));
        Ok(Self::new(Backend::Inline { renderer, device, done: None }))
    }

    /// An engine on a thread of its own, with another device on the adapter of the window's.
    pub(crate) fn on_thread(
        window: Gpu,
        size: (u32, u32),
        open: Open,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> Result<Self, Error> {
        let device = Device::default();
        let thread = RenderThread::start(open.clone(), device.clone(), size, window.rasteriser(), wake.clone())?;
        let display = Presenter::texture(&window, size.0, size.1).map_err(EngineError::from)?;
        let gate = Gate::default();
        let remote = ThreadBackend { thread, device, gate, open, wake, window, display, took: Duration::MAX };
        let mut drawing = Self::new(Backend::RenderThread(Box::new(remote)));
        drawing.in_flight = Some(InFlight::opening(Instant::now(), 0));
        Ok(drawing)
    }

    fn new(backend: Backend) -> Self {
        Self { backend, serial: 0, in_flight: None, abandoned: Vec::new() }
    }

    /// Returns whether frames are drawn by the processor that also paints the window.
    pub(crate) fn shares_processor(&self) -> bool {
        matches!(&self.backend, Backend::RenderThread(remote) if remote.window.rasteriser().shares_processor())
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
            Backend::RenderThread(remote) => &remote.display.level_0,
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

    /// Shows a picture of the other device. Returns whether the display is a different texture now.
    pub(crate) fn show(&mut self, picture: &Picture) -> Result<bool, GpuError> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(false) };
        let size = (picture.width, picture.height);
        let is_new = size != (remote.display.width(), remote.display.height());
        if is_new {
            remote.display = Presenter::texture(&remote.window, size.0, size.1)?;
        }
        remote.display.write(&remote.window, &picture.bytes);
        Ok(is_new)
    }

    /// Shows the picture on a new device, as the previous one is lost. There is no picture until one is delivered.
    pub(crate) fn show_on(&mut self, window: Gpu) -> Result<(), GpuError> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(()) };
        remote.display = Presenter::texture(&window, remote.display.width(), remote.display.height())?;
        (remote.window, remote.open) = (window.clone(), beside(window));
        Ok(())
    }

    /// Abandons the thread and its device, and starts new ones. The picture stays until there is another.
    pub(crate) fn restart_thread(&mut self, now: Instant, size: (u32, u32)) -> std::io::Result<()> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(()) };
        let device = Device::default();
        let ThreadBackend { open, wake, window, .. } = &**remote;
        let thread = RenderThread::start(open.clone(), device.clone(), size, window.rasteriser(), wake.clone())?;
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
