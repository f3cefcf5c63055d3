//! The way from the session to the engine: what it is to draw goes out, pictures and figures come back.
//!
//! Owns the engine, which draws here at once, or on a thread and a device of its own. It gets one job at a time, and
//! what is wanted meanwhile waits here, each the newest of its kind: nothing piles up, and nobody waits for a frame.
//! Knows nothing of texts, of time or of what a person is told.

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

/// A job is waited for so long if the one before came back sooner: a picture that is drawn fast is seen in the frame
/// that asks for it.
const PATIENCE: Duration = Duration::from_millis(4);

/// The engine, wherever it draws.
pub(super) struct Drawing {
    backend: Backend,
    /// Goes with the next job.
    pub wanted: Changes,
    facts: Facts,
    in_flight: Option<InFlight>,
    /// Threads that were given up and may still be at work.
    left: Vec<JoinHandle<()>>,
}

/// Holds what is known of the engine since its last answer.
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
    /// The origin of the program that it sets.
    program: Option<ProgramOrigin>,
    /// The thread opens its device; nothing of the author's is drawn yet.
    is_opening: bool,
    /// Another project has been opened since: what comes back is of one that is gone.
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
    /// Says what a frame does that may wait.
    gate: Gate,
    open: Open,
    wake: Arc<dyn Fn() + Send + Sync>,
    window: Gpu,
    display: Texture,
    /// The time that the newest job took on its thread.
    took: Duration,
}

impl Drawing {
    /// An engine that does each job at once.
    pub(crate) fn inline(gpu: Gpu, size: (u32, u32)) -> Result<Self, EngineError> {
        let clock = clock(&gpu);
        let (renderer, device) = (Box::new(Renderer::new(gpu.clone(), size, false)?), Device::open(gpu));
        Ok(Self::new(Backend::Inline { renderer, device, done: None }, size, clock))
    }

    /// An engine on a thread of its own, with another device of the adapter that the window's is on.
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

    /// Frames are drawn by the processor that paints the window, too.
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

    /// The newest picture, its first row the top.
    pub(crate) fn display(&self) -> &wgpu::TextureView {
        match &self.backend {
            Backend::Inline { renderer, .. } => renderer.engine().display(),
            Backend::RenderThread(remote) => &remote.display.level_0,
        }
    }

    /// The canvas of the newest picture.
    pub(crate) fn size(&self) -> (u32, u32) {
        self.facts.size
    }

    /// The canvas of the engine once it has done its job.
    pub(crate) fn coming_size(&self) -> (u32, u32) {
        self.in_flight.as_ref().and_then(|job| job.size).unwrap_or(self.facts.size)
    }

    /// A program is there to draw.
    pub(crate) fn has_program(&self) -> bool {
        self.facts.program.is_some()
    }

    /// A program waits to be taken up.
    pub(crate) fn is_program_coming(&self) -> bool {
        self.wanted.program.is_some() || self.in_flight.as_ref().is_some_and(|job| job.program.is_some())
    }

    /// The project of the program that draws.
    pub(crate) fn project(&self) -> Option<&Project> {
        self.facts.program.as_ref().map(|program| &program.project)
    }

    /// The program that draws is of the newest text that compiled, and not one to fall back to.
    pub(crate) fn is_newest_program(&self) -> bool {
        self.new_program_millis().is_some()
    }

    /// Milliseconds of the compile of such a program.
    pub(crate) fn new_program_millis(&self) -> Option<f64> {
        self.facts.program.as_ref().and_then(|program| program.millis)
    }

    /// The author's own uniforms, as the program that draws declares them.
    pub(crate) fn custom_uniforms(&self) -> &[CustomUniform] {
        self.facts.program.as_ref().map_or(&[], |program| &program.custom_uniforms)
    }

    /// The program draws a pass.
    pub(crate) fn draws(&self, pass: &PassName) -> bool {
        self.facts.program.as_ref().is_some_and(|program| program.drawn.contains(pass))
    }

    /// The passes' costs as they were when somebody looked last.
    pub(crate) fn costs(&self) -> &[PassCost] {
        &self.facts.costs
    }

    /// The frames that one can go to.
    pub(crate) fn reach(&self) -> Reach {
        self.facts.reach
    }

    pub(crate) fn clock(&self) -> CostClock {
        self.facts.clock
    }

    /// The engine has a job: no other can be handed in.
    pub(crate) fn is_busy(&self) -> bool {
        self.in_flight.is_some()
    }

    /// Since when the engine draws, if it does.
    pub(crate) fn draws_since(&self) -> Option<Instant> {
        self.in_flight.as_ref().filter(|job| !job.is_opening).map(|job| job.since)
    }

    /// Begins anew, for another project. What was wanted of the one before is not wanted any more.
    pub(crate) fn restart(&mut self) {
        // One that is being made is new.
        let restart = self.in_flight.as_ref().is_none_or(|job| !job.is_opening);
        self.wanted = Changes { restart, ..Changes::default() };
        self.facts.program = None;
        self.facts.costs.clear();
        if let Some(job) = self.in_flight.as_mut().filter(|job| !job.is_opening) {
            (job.is_stale, job.program) = (true, None);
        }
    }

    /// Says what the frame that is being drawn does, if it may wait.
    pub(crate) fn steer(&self, control: FrameControl) {
        if let Backend::RenderThread(remote) = &self.backend {
            remote.gate.set(control);
        }
    }

    /// Returns what the frame does that is being drawn.
    #[cfg(test)]
    pub(crate) fn frame_control(&self) -> Option<FrameControl> {
        match &self.backend {
            Backend::Inline { .. } => None,
            Backend::RenderThread(remote) => Some(remote.gate.get()),
        }
    }

    /// Hands in a job with everything that is wanted, and what else `fill` puts in. The engine has none. With
    /// `may_wait` its frame follows [`Drawing::steer`].
    pub(crate) fn submit(&mut self, now: Instant, may_wait: bool, fill: impl FnOnce(&mut Job)) {
        let mut job = Job { changes: std::mem::take(&mut self.wanted), ..Job::default() };
        fill(&mut job);
        if let Backend::RenderThread(remote) = &self.backend {
            remote.gate.set(FrameControl::GoOn);
            job.gate = may_wait.then(|| remote.gate.clone());
        }
        // The program goes on, what the session keeps of it stays.
        let program = job.changes.program.as_mut().and_then(|coming| coming.origin.take());
        let size = job.changes.size;
        self.in_flight = Some(InFlight { since: now, size, program, is_opening: false, is_stale: false });
        match &mut self.backend {
            Backend::Inline { renderer, done, .. } => *done = Some(Box::new(renderer.work(job))),
            Backend::RenderThread(remote) => remote.thread.submit(job),
        }
    }

    /// Returns the answer to the job, once. Waits for a moment where the last one took no longer.
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
        // Outputs that belong to a project that is gone have no ticket any more.
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

    /// Shows a picture that came from the other device. Says whether the display is another texture now.
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

    /// Shows the picture on another device than before, which is lost. There is none until one is handed out.
    pub(crate) fn show_on(&mut self, window: Gpu) -> Result<(), GpuError> {
        let Backend::RenderThread(remote) = &mut self.backend else { return Ok(()) };
        remote.display = Presenter::texture(&window, remote.display.width(), remote.display.height())?;
        (remote.window, remote.open) = (window.clone(), beside(window));
        Ok(())
    }

    /// Draws nothing more of the program that is there. The picture stays until there is another.
    pub(crate) fn drop_program(&mut self) {
        self.facts.program = None;
        if let Some(job) = &mut self.in_flight {
            job.program = None;
        }
    }

    /// Gives up the thread and its device, and begins with others. The picture stays until there is another.
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

    /// The number of threads that were given up and have not come back.
    pub(crate) fn lost_threads(&mut self) -> usize {
        self.left.retain(|thread| !thread.is_finished());
        self.left.len()
    }

    /// Waits until the engine has ended its job, but not for long. False if it goes on.
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

    /// Ends an engine that rests.
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

/// There is no engine.
#[derive(Debug, thiserror::Error)]
pub(super) enum Error {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("cannot start a thread for drawing: {0}")]
    Thread(#[from] std::io::Error),
}
