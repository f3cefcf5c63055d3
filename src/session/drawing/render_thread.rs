//! An engine on a thread of its own, so that only the next frame waits for a frame.

use super::{
    job::{Job, JobResult},
    renderer::{Delivery, Renderer},
};
use eddy_gpu::{Gpu, GpuError, Rasteriser, Slices};
use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc, OnceLock,
        atomic::AtomicBool,
        mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// Drivers compile on the thread that draws, and recurse as deeply as an expression is nested. Untouched pages cost
/// nothing.
const STACK_BYTES: usize = 256 << 20;

/// Opens a device. Called on the drawing thread.
pub(crate) type Open = Arc<dyn Fn() -> Result<Gpu, GpuError> + Send + Sync>;

/// The time for which a frame occupies a GPU before the window is painted: half of a frame at 60 Hz.
const SLICE: Duration = Duration::from_millis(8);

/// Opens the device that draws frames. A GPU has one for all, so that the picture stays there, and frames are submitted
/// in slices. On the processor it is another device, whose threads have a lower priority.
pub(crate) fn for_frames(window: Gpu) -> Open {
    match window.rasteriser().shares_processor() {
        true => for_background(window),
        false => {
            let began = Instant::now();
            let now = Arc::new(move || began.elapsed().as_secs_f64() * 1e3);
            Arc::new(move || Ok(window.in_slices(Slices { limit: SLICE, now: now.clone() })))
        }
    }
}

/// Opens the device for work beside the window ([`Gpu::for_background`]).
pub(crate) fn for_background(window: Gpu) -> Open {
    Arc::new(move || Ok(window.for_background()))
}

/// The drawing thread. When dropped, it ends after the job in progress, which is not waited for.
pub(super) struct RenderThread {
    /// `None` after the last job.
    jobs: Option<Sender<Job>>,
    /// The results of jobs, or the reason why the thread ends.
    results: Receiver<Result<JobResult, String>>,
    thread: Option<JoinHandle<()>>,
}

impl RenderThread {
    /// Starts the thread. Its first answer reports whether there is an engine; `wake` is called after each. `stop` ends a
    /// frame on a device that is shared with the window.
    pub(super) fn start(
        open: Open,
        device: Device,
        size: (u32, u32),
        stop: Arc<AtomicBool>,
        rasteriser: Rasteriser,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> std::io::Result<RenderThread> {
        let (jobs, queue) = channel::<Job>();
        let (sender, results) = channel();
        let tell = move |done| {
            let is_heard = sender.send(done).is_ok();
            wake();
            is_heard
        };
        let work = move || {
            rasteriser.lower_thread_priority();
            let opened = caught(|| open().map_err(|e| e.to_string())).and_then(|opened| opened);
            device.set(opened.clone());
            let renderer = opened.and_then(|gpu| {
                let delivery = if gpu.slices.is_some() { Delivery::Texture } else { Delivery::Bytes };
                let renderer = || Renderer::new(gpu, size, delivery, stop).map_err(|e| e.to_string());
                caught(renderer).and_then(|renderer| renderer)
            });
            let mut renderer = match renderer {
                Ok(renderer) => renderer,
                Err(why) => {
                    tell(Err(why));
                    return;
                }
            };
            if !tell(Ok(JobResult::default())) {
                return;
            }
            while let Ok(job) = queue.recv() {
                let began = Instant::now();
                let done = caught(|| renderer.work(job)).map(|done| JobResult { took: began.elapsed(), ..done });
                let is_over = done.is_err();
                if !tell(done.map_err(|why| format!("this is a bug in Eddy: {why}"))) || is_over {
                    return;
                }
            }
        };
        let thread = std::thread::Builder::new().name("drawing".into()).stack_size(STACK_BYTES).spawn(work)?;
        Ok(RenderThread { jobs: Some(jobs), results, thread: Some(thread) })
    }

    /// Submits a job.
    pub(super) fn submit(&self, job: Job) {
        if let Some(jobs) = &self.jobs {
            // A thread that has ended reported why, or its closed channel does.
            let _ = jobs.send(job);
        }
    }

    /// Returns the answer to the submitted job, if it arrives within a time.
    pub(super) fn take(&self, within: Duration) -> Option<Result<JobResult, String>> {
        let ended = || Some(Err("the drawing thread has ended".into()));
        if within.is_zero() {
            return match self.results.try_recv() {
                Ok(done) => Some(done),
                Err(TryRecvError::Empty) => None,
                Err(TryRecvError::Disconnected) => ended(),
            };
        }
        match self.results.recv_timeout(within) {
            Ok(done) => Some(done),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => ended(),
        }
    }

    /// Detaches the thread, which ends as soon as it can.
    pub(super) fn leave(mut self) -> Option<JoinHandle<()>> {
        self.thread.take()
    }

    /// Waits until the thread has ended, with its device.
    pub(super) fn end(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            // A panic of it was reported.
            let _ = thread.join();
        }
    }
}

/// Returns the message of a panic instead of propagating it.
fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload: Box<dyn Any + Send>| {
        let said = payload.downcast_ref::<&str>().map(|s| (*s).to_owned());
        said.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason given".into())
    })
}

/// A slot for a device that is still being opened. All clones share the slot.
#[derive(Clone, Default)]
pub(crate) struct Device(Arc<OnceLock<Result<Gpu, String>>>);

impl Device {
    /// A device that is open.
    pub(crate) fn open(gpu: Gpu) -> Self {
        let device = Self::default();
        device.set(Ok(gpu));
        device
    }

    /// Sets the device, or the reason why there is none. The first call wins.
    pub(crate) fn set(&self, gpu: Result<Gpu, String>) {
        let _ = self.0.set(gpu);
    }

    /// Waits until it is open.
    pub(crate) fn wait(&self) -> Result<Gpu, GpuError> {
        self.0.wait().clone().map_err(|reason| GpuError::NoDevice { adapter: "the machine".into(), reason })
    }
}
