//! A run on a thread of its own, told of over a channel.

use super::{
    CostRecord, ErrorRecord, LabError, Point, Results, Stop, Study,
    run::{self, Control, Options, Step},
};
use eddy_gpu::{self as gpu, Gpu, GpuError};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        mpsc::{Receiver, RecvTimeoutError, channel},
    },
    thread::JoinHandle,
    time::Duration,
};

/// Says how long a run that is dropped may take to its next frame. One that computes a reference longer is left behind.
const PATIENCE: Duration = Duration::from_secs(3);

/// Steps that the thread takes back behind others (`nice`), where a thread can: what a processor draws for a window
/// goes first.
const STEPS_BACK: i32 = 10;

/// Carries what the thread says.
#[derive(Clone, Debug)]
pub enum Event {
    /// Says what the folder holds already.
    Resumed(Results),
    Progress(Progress),
    Measured(ErrorRecord),
    /// About what a frame of the point costs; its [`Event::Costed`] comes later.
    Estimate {
        point: Point,
        millis: f64,
    },
    Costed(CostRecord),
    /// The last event. Not an error if the run was stopped.
    Ended(Result<(), String>),
}

/// Says what is done now.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// The device is opened.
    Begins,
    /// The error of a point.
    Error { point: Point, done: usize, all: usize },
    /// Costs of a study's points.
    Cost { points: usize },
    /// Their turns.
    Turn { done: u32, all: u32 },
}

/// A run. Dropped, it ends.
pub struct Background {
    events: Receiver<Event>,
    stop: Stop,
    thread: Option<JoinHandle<()>>,
}

impl Background {
    /// Measures on a device that `open` opens on the run's thread. `wake` is called after each event.
    pub fn start(
        open: impl FnOnce() -> Result<Gpu, GpuError> + Send + 'static,
        studies: Vec<&'static Study>,
        options: Options,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> std::io::Result<Background> {
        let (sender, events) = channel();
        let stop = Stop::default();
        let control = Control { stop: stop.clone(), estimates: true, beside_window: true };
        let work = move || {
            gpu::step_back(STEPS_BACK);
            let tell = |event: Event| {
                // Whoever hung up has given the stop, too.
                let _ = sender.send(event);
                wake();
            };
            let run = || measure(open, &studies, &options, &control, &tell);
            let ended = catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| Err("this is a bug in Eddy".into()));
            tell(Event::Ended(ended));
        };
        let thread = std::thread::Builder::new().name("lab".into()).spawn(work)?;
        Ok(Background { events, stop, thread: Some(thread) })
    }

    /// Returns what has been said since the last call. Does not wait.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        self.events.try_iter()
    }

    /// Ends the run at its next frame; [`Event::Ended`] follows.
    pub fn stop(&self) {
        self.stop.now();
    }

    pub fn is_stopping(&self) -> bool {
        self.stop.is_wanted()
    }
}

impl Drop for Background {
    /// A thread inside a driver should not outlive the process.
    fn drop(&mut self) {
        self.stop.now();
        loop {
            match self.events.recv_timeout(PATIENCE) {
                Ok(Event::Ended(_)) | Err(RecvTimeoutError::Disconnected) => break,
                Ok(_) => {}
                Err(RecvTimeoutError::Timeout) => return,
            }
        }
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn measure(
    open: impl FnOnce() -> Result<Gpu, GpuError>,
    studies: &[&Study],
    options: &Options,
    control: &Control,
    tell: &dyn Fn(Event),
) -> Result<(), String> {
    tell(Event::Progress(Progress::Begins));
    let said = |error: LabError| error.to_string();
    let gpu = open().map_err(|e| said(e.into()))?;
    let passed_on = |step: Step<'_>| {
        tell(match step {
            Step::Resumed(results) => Event::Resumed(results.clone()),
            Step::Error { point, done, all } => Event::Progress(Progress::Error { point: point.clone(), done, all }),
            Step::Measured(record) => Event::Measured(record.clone()),
            Step::Estimate { point, millis } => Event::Estimate { point: point.clone(), millis },
            Step::Cost { points, .. } => Event::Progress(Progress::Cost { points }),
            Step::Turn { done, all } => Event::Progress(Progress::Turn { done, all }),
            Step::Costed(record) => Event::Costed(record.clone()),
        });
    };
    run::controlled(&gpu, studies, options, control, passed_on).map(drop).map_err(said)
}
