//! The connection from the session to the engine: jobs go out, pictures and measurements come back.
//!
//! Owns the engine, which draws synchronously, or on a thread and a device of its own. It gets one job at a time.
//! Requests that arrive meanwhile wait here, and a newer one of a kind replaces the older: no queue builds up, and
//! nothing blocks on a frame. Knows nothing of texts, time or messages to the user.

mod gate;
mod history;
mod job;
mod render_thread;
mod renderer;
mod task;

pub(super) use gate::FrameControl;
pub(super) use history::SeekProgress;
pub(super) use job::{Changes, Done, DrawnFrame, Job, PendingProgram, ProgramOrigin, TileLimit};
pub(super) use render_thread::{Device, Open, beside};
pub(super) use renderer::Renderer;
pub(super) use task::{Finished, RenderTask, Tasks, Ticket};

use crate::playback::Reach;
use eddy_engine::{CostClock, EngineError, PassCost, Picture};
use eddy_gpu::{Gpu, GpuError, Presenter, Texture};
use eddy_project::{CustomUniform, PassName, Project};
use gate::Gate;
use render_thread::RenderThread;
use std::{
    sync::Arc,
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// A job is waited for this long if the previous one was faster: a picture that is drawn quickly appears in the frame
/// that requests it.
const PATIENCE: Duration = Duration::from_millis(4);

/// The engine, on this thread or another.
pub(super) struct Drawing {
    backend: Backend,
    /// Submitted with the next job.
    pub wanted: Changes,
    facts: Facts,
    in_flight: Option<InFlight>,
    /// Threads that were abandoned and may still be running.
    left: Vec<JoinHandle<()>>,
}

/// The state of the engine after its last answer.
struct Facts {
    size: (u32, u32),
    program: Option<ProgramOrigin>,
    costs: Vec<PassCost>,
    clock: CostClock,
    reach: Reach,
}

struct InFlight {
    since: Instant,
    size: Option<(u32, u32)>,
    /// The origin of the program that the job sets.
    program: Option<ProgramOrigin>,
    /// The thread opens its device; no code of the author runs yet.
    is_opening: bool,
    /// Another project has been opened since: the result belongs to the previous one.
    is_stale: bool,
}

enum Backend {
    Inline { renderer: Box<Renderer>, device: Device, done: Option<Box<Done>> },
    RenderThread(Box<Remote>),
}

/// An engine on another thread, and its newest picture on the window's device.
struct Remote {
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
        let clock = clock(&gpu);
        let (renderer, device) = (Box::new(Renderer::new(gpu.clone(), size, false)?), Device::open(gpu));
        Ok(Self::new(Backend::Inline { renderer, device, done: None }, size, clock))
    }

    /// An engine on a thread of its own, with another device on the adapter of the window's.
    pub(crate) fn on_thread(
        window: Gpu,
        size: (u32, u32),
        open: Open,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> Result<Self, Error> {
        let clock = clock(&window);
        let device = Device::default();
        let thread = RenderThread::start(open.clone(), device.clone(), size, window.is_cpu(), wake.clone())?;
        let display = Presenter::texture(&window, size.0, size.1).map_err(EngineError::from)?;
        let gate = Gate::default();
        let remote = Remote { thread, device, gate, open, wake, window, display, took: Duration::MAX };
        let mut drawing = Self::new(Backend::RenderThread(Box::new(remote)), size, clock);
        drawing.in_flight = Some(InFlight::opening(Instant::now()));
        Ok(drawing)
    }

    fn new(backend: Backend, size: (u32, u32), clock: CostClock) -> Self {
        Self {
            backend,
            wanted: Changes::default(),
            facts: Facts { size, program: None, costs: Vec::new(), clock, reach: Reach::default() },
            in_flight: None,
            left: Vec::new(),
        }
    }

    /// Returns whether frames are drawn by the processor that also paints the window.
    pub(crate) fn shares_processor(&self) -> bool {
        matches!(&self.backend, Backend::RenderThread(remote) if remote.window.is_cpu())
    }

    pub(crate) fn is_apart(&self) -> bool {
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

    /// The canvas size of the newest picture.
    pub(crate) fn size(&self) -> (u32, u32) {
        self.facts.size
    }

    /// The canvas size of the engine after the job in flight.
    pub(crate) fn coming_size(&self) -> (u32, u32) {
        self.in_flight.as_ref().and_then(|job| job.size).unwrap_or(self.facts.size)
    }

    /// Returns whether the engine has a program.
    pub(crate) fn has_program(&self) -> bool {
        self.facts.program.is_some()
    }

    /// Returns whether a program is pending or in flight.
    pub(crate) fn is_program_coming(&self) -> bool {
        self.wanted.program.is_some() || self.in_flight.as_ref().is_some_and(|job| job.program.is_some())
    }

    /// The project of the program that draws.
    pub(crate) fn project(&self) -> Option<&Project> {
        self.facts.program.as_ref().map(|program| &program.project)
    }

    /// Returns whether the current program is of the newest text that compiled, not a fallback.
    pub(crate) fn is_newest_program(&self) -> bool {
        self.new_program_millis().is_some()
    }

    /// Milliseconds of its compile, if the current program is of the newest text.
    pub(crate) fn new_program_millis(&self) -> Option<f64> {
        self.facts.program.as_ref().and_then(|program| program.millis)
    }

    /// The author's own uniforms, as the current program declares them.
    pub(crate) fn custom_uniforms(&self) -> &[CustomUniform] {
        self.facts.program.as_ref().map_or(&[], |program| &program.custom_uniforms)
    }

    /// Returns whether the program draws a pass.
    pub(crate) fn draws(&self, pass: &PassName) -> bool {
        self.facts.program.as_ref().is_some_and(|program| program.drawn.contains(pass))
    }

    /// The passes' costs when they were last requested.
    pub(crate) fn costs(&self) -> &[PassCost] {
        &self.facts.costs
    }

    /// The range of frames for seeking.
    pub(crate) fn reach(&self) -> Reach {
        self.facts.reach
    }

    pub(crate) fn clock(&self) -> CostClock {
        self.facts.clock
    }

    /// Returns whether the engine has a job: no other can be submitted.
    pub(crate) fn is_busy(&self) -> bool {
        self.in_flight.is_some()
    }

    /// The time since which the engine has been drawing, if it is.
    pub(crate) fn draws_since(&self) -> Option<Instant> {
        self.in_flight.as_ref().filter(|job| !job.is_opening).map(|job| job.since)
    }

    /// Restarts for another project, dropping pending requests of the previous one.
    pub(crate) fn restart(&mut self) {
        // An engine that is being opened is new already.
        let restart = self.in_flight.as_ref().is_none_or(|job| !job.is_opening);
        self.wanted = Changes { restart, ..Changes::default() };
        self.facts.program = None;
        self.facts.costs.clear();
        if let Some(job) = self.in_flight.as_mut().filter(|job| !job.is_opening) {
            (job.is_stale, job.program) = (true, None);
        }
    }

    /// Controls the frame that is being drawn, if it may wait.
    pub(crate) fn steer(&self, control: FrameControl) {
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

    /// Submits a job with all pending changes and what `fill` adds. The engine must be idle. With `may_wait` its frame
    /// follows [`Drawing::steer`].
    pub(crate) fn submit(&mut self, now: Instant, may_wait: bool, fill: impl FnOnce(&mut Job)) {
        let mut job = Job { changes: std::mem::take(&mut self.wanted), ..Job::default() };
        fill(&mut job);
        if let Backend::RenderThread(remote) = &self.backend {
            remote.gate.set(FrameControl::GoOn);
            job.gate = may_wait.then(|| remote.gate.clone());
        }
        // The program is submitted; the session keeps its origin.
        let program = job.changes.program.as_mut().and_then(|coming| coming.origin.take());
        let size = job.changes.size;
        self.in_flight = Some(InFlight { since: now, size, program, is_opening: false, is_stale: false });
        match &mut self.backend {
            Backend::Inline { renderer, done, .. } => *done = Some(Box::new(renderer.work(job))),
            Backend::RenderThread(remote) => remote.thread.submit(job),
        }
    }

    /// Returns the answer to the job, once. Waits for a moment if the last job was that fast.
    pub(crate) fn take(&mut self, is_just_handed_in: bool) -> Option<Done> {
        self.in_flight.as_ref()?;
        let mut done = match &mut self.backend {
            Backend::Inline { done, .. } => done.take().map(|done| *done),
            Backend::RenderThread(remote) => {
                let waits = is_just_handed_in && remote.took < PATIENCE;
                remote.thread.take(if waits { PATIENCE } else { Duration::ZERO })
            }
        }?;
        let job = self.in_flight.take()?;
        if let Backend::RenderThread(remote) = &mut self.backend {
            remote.took = done.took;
        }
        // Outputs for a project that was closed have no ticket any longer.
        done.outputs.drain(..).for_each(|deliver| deliver());
        if job.is_stale {
            if let Some((size, Ok(()))) = &done.resized {
                self.facts.size = *size;
            }
            return Some(Done { gave_up: done.gave_up, ..Done::default() });
        }
        self.learn(job, &mut done);
        Some(done)
    }

    fn learn(&mut self, job: InFlight, done: &mut Done) {
        if let Some((size, Ok(()))) = &done.resized {
            self.facts.size = *size;
        }
        if let Some(Ok(())) = &done.program {
            self.facts.program = job.program;
        }
        self.facts.reach = done.reach;
        self.facts.clock = done.clock.unwrap_or(self.facts.clock);
        if let Some(costs) = done.costs.take() {
            self.facts.costs = costs;
        }
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

    /// Drops the current program. The picture stays until there is another.
    pub(crate) fn drop_program(&mut self) {
        self.facts.program = None;
        if let Some(job) = &mut self.in_flight {
            job.program = None;
        }
    }

    /// Abandons the thread and its device, and starts new ones. The picture stays until there is another.
    pub(crate) fn start_anew(&mut self, now: Instant) -> std::io::Result<()> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(()) };
        let device = Device::default();
        let Remote { open, wake, window, .. } = &**remote;
        let thread = RenderThread::start(open.clone(), device.clone(), self.facts.size, window.is_cpu(), wake.clone())?;
        (remote.device, remote.gate, remote.took) = (device, Gate::default(), Duration::MAX);
        self.left.extend(std::mem::replace(&mut remote.thread, thread).leave());
        self.facts.program = None;
        self.wanted = Changes::default();
        self.in_flight = Some(InFlight::opening(now));
        Ok(())
    }

    /// The number of abandoned threads that have not ended.
    pub(crate) fn lost_threads(&mut self) -> usize {
        self.left.retain(|thread| !thread.is_finished());
        self.left.len()
    }

    /// Waits for the end of the job, up to `patience`. Returns false if it is still running.
    pub(crate) fn rest(&mut self, patience: Duration) -> bool {
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
    fn opening(since: Instant) -> Self {
        Self { since, size: None, program: None, is_opening: true, is_stale: false }
    }
}

fn clock(gpu: &Gpu) -> CostClock {
    if gpu.has_timestamps { CostClock::Timestamps } else { CostClock::Waited }
}

/// The engine does not exist.
#[derive(Debug, thiserror::Error)]
pub(super) enum Error {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("cannot start a thread for drawing: {0}")]
    Thread(#[from] std::io::Error),
}
