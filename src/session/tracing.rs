//! A pixel of the picture that is being traced: from the click to the way that led to its value.
//!
//! The inputs of the pass are taken after the frame, from textures that still hold them, so that nothing is drawn anew
//! and no simulation goes on. The walk is done on a thread of its own.

use super::{
    parting::Finding,
    trace::Traced,
    worker::{Panicked, Worker},
};
use eddy_engine::{PassInputs, Pixels};
use eddy_project::{PassId, Project};
use std::sync::Arc;

/// The inputs and the picture that were taken of a pass.
pub(super) type Taken = (PassInputs, Pixels);

/// A pixel of a pass: where in its picture, from 0 to 1 across and up.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    pub pass: PassId,
    pub at: [f32; 2],
}

pub(super) struct Job {
    pub project: Project,
    pub place: Place,
    pub frame: i32,
    pub taken: Taken,
}

/// Holds what a front end shows of a trace.
#[derive(Clone, Copy, Debug, Default)]
pub struct TraceView<'s> {
    /// The newest, while another one is under way too.
    pub traced: Option<&'s Arc<Traced>>,
    pub is_under_way: bool,
    /// The reason why there is none.
    pub trouble: Option<&'s str>,
}

pub(super) struct Tracing {
    worker: Worker<Job, Result<Traced, String>>,
    /// The pixel that is traced, again after each change of what it shows.
    place: Option<Place>,
    /// The inputs of its pass are to be taken.
    pub is_due: bool,
    newest: Option<Arc<Traced>>,
    trouble: Option<String>,
    /// Says where the device parts from the walker in it.
    pub finding: Finding,
}

impl Tracing {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let work = |job: Job| {
            let Job { project, place, frame, taken: (inputs, drawn) } = job;
            Traced::new(project, &place.pass, frame, (inputs, &drawn), place.at).map_err(|e| e.to_string())
        };
        let finding = Finding::new(wake.clone())?;
        let worker = Worker::new("trace", wake, work)?;
        Ok(Self { worker, place: None, is_due: false, newest: None, trouble: None, finding })
    }

    /// Traces another pixel, or none.
    pub fn want(&mut self, place: Option<Place>) {
        self.is_due = place.is_some();
        self.trouble = None;
        if place.is_none() {
            self.newest = None;
            self.finding.want(None);
        }
        self.place = place;
    }

    /// Another project is open.
    pub fn forget(&mut self) {
        self.want(None);
        self.worker.forget();
        self.finding.forget();
    }

    pub fn place(&self) -> Option<&Place> {
        self.place.as_ref()
    }

    /// Another frame was drawn: the pixel is traced anew.
    pub fn drew(&mut self) {
        self.is_due = self.place.is_some();
    }

    pub fn submit(&mut self, job: Job) {
        self.worker.submit(job);
    }

    pub fn failed(&mut self, why: String) {
        self.trouble = Some(why);
        self.newest = None;
    }

    /// Looks for where the device parts from the walker in the traced pixel.
    pub fn find_parting(&mut self) {
        self.finding.want(self.newest.as_ref());
    }

    /// Takes a walk or a search that has ended. Says whether one has.
    pub fn take(&mut self) -> bool {
        let has_found = self.finding.take();
        match self.worker.take() {
            None => return has_found,
            Some(_) if self.place.is_none() => {}
            Some(Ok(Ok(traced))) => (self.newest, self.trouble) = (Some(Arc::new(traced)), None),
            Some(Ok(Err(why))) => self.failed(why),
            Some(Err(Panicked(why))) => {
                self.failed(format!("this is a bug in Eddy: the CPU interpreter failed ({why})"))
            }
        }
        true
    }

    pub fn view(&self) -> TraceView<'_> {
        TraceView {
            traced: self.newest.as_ref(),
            is_under_way: self.is_due || self.worker.is_busy(),
            trouble: self.trouble.as_deref(),
        }
    }
}
