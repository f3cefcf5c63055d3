//! A run on a thread of its own, which tells what happens.

use super::{
    CostRecord, ErrorRecord, LabError, Point, Results, Stop, Study,
    run::{self, Control, Options, Step},
};
use eddy_background::{Background, Control as Told, Wake};
use eddy_gpu::{self as gpu, Gpu, GpuError};
use std::time::Duration;

/// The time that a run which is dropped may take to its next frame. One that computes a reference for longer is left alone.
const PATIENCE: Duration = Duration::from_secs(3);

/// Steps that the thread takes back behind others (`nice`), where a thread can: what a processor draws for a window
/// goes first.
const STEPS_BACK: i32 = 10;

/// Carries what the thread says.
#[derive(Clone, Debug, PartialEq)]
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
pub struct BackgroundRun {
    work: Background<(), Vec<Event>, ()>,
}

impl BackgroundRun {
    /// Measures on a device that `open` opens on the run's thread. `wake` is called after each event.
    pub fn start(
        open: impl FnOnce() -> Result<Gpu, GpuError> + Send + 'static,
        studies: Vec<&'static Study>,
        options: Options,
        wake: Wake,
    ) -> std::io::Result<BackgroundRun> {
        let work = Background::once("lab", "the measurement", wake, move |told: &Told<Vec<Event>>| {
            gpu::lower_thread_priority(STEPS_BACK);
            let control = Control { stop: Stop::of(told.cancel_flag()), estimates: true, beside_window: true };
            measure(open, &studies, &options, &control, &|event| told.update(|events| events.push(event)))
        })?;
        Ok(BackgroundRun { work })
    }

    /// Returns what has been said since the last call. Does not wait.
    pub fn events(&mut self) -> Vec<Event> {
        // First, as every event is said before the end.
        let ended = self.work.take();
        let mut events = self.work.take_progress();
        events.extend(ended.map(Event::Ended));
        events
    }

    /// Ends the run at its next frame; [`Event::Ended`] follows.
    pub fn stop(&self) {
        self.work.stop();
    }

    pub fn is_stopping(&self) -> bool {
        self.work.is_stopping()
    }
}

impl Drop for BackgroundRun {
    /// A thread inside a driver should not outlive the process.
    fn drop(&mut self) {
        self.work.end(PATIENCE);
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
