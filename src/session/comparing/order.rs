//! The comparison that somebody has asked for, on a thread of its own.

use super::{
    comparison::{Against, Compared, Comparison, ComparisonView, Progress},
    work::{self, Job, Reference},
};
use crate::{
    drawing::Run,
    worker::{Panicked, Worker},
};
use eddy_engine::Trial;
use eddy_gpu::Gpu;
use eddy_project::{Origin, PassId, Project};
use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
    time::{Duration, Instant},
};

/// Holds the projects that are to be compared.
pub(crate) struct Order {
    pub gpu: Gpu,
    pub project: Project,
    pub saved: Project,
    pub revision: u64,
    pub shown: PassId,
    pub media_dir: Option<PathBuf>,
    /// The other project may be one that the driver takes minutes for.
    pub trial: Option<Trial>,
    pub run: Run,
}

/// `None`: nobody wants it any more.
type End = Option<Result<Arc<Comparison>, String>>;

pub(crate) struct Comparing {
    worker: Worker<(Job, Arc<Progress>), End>,
    against: Option<Against>,
    /// The frames are to be handed out.
    pub is_due: bool,
    progress: Arc<Progress>,
    /// The progress that a front end knows of.
    told: usize,
    end: End,
}

impl Comparing {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let tell = wake.clone();
        let work = move |(job, progress): (Job, Arc<Progress>)| {
            let end = work::compare(job, &progress, &*tell).transpose()?;
            Some(end.map(Arc::new))
        };
        let worker = Worker::new("comparison", wake, work)?;
        Ok(Self { worker, against: None, is_due: false, progress: Arc::default(), told: 0, end: None })
    }

    /// Begins anew, or stops. What was found before stays until there is something newer.
    pub fn want(&mut self, against: Option<Against>) {
        self.progress.is_over.store(true, Ordering::Relaxed);
        self.is_due = against.is_some();
        self.against = against;
    }

    /// Another project is open.
    pub fn forget(&mut self) {
        self.want(None);
        self.worker.forget();
        self.end = None;
    }

    pub fn submit(&mut self, order: Order) {
        let Some(against) = self.against.clone() else { return };
        let Order { gpu, project, saved, revision, shown, media_dir, trial, run } = order;
        let reference = match (&against, &project.origin) {
            (Against::LastSave, _) => Reference::Project(Box::new(saved)),
            (Against::Project(spec), _) => Reference::Load(spec.clone()),
            (Against::Revision(revision), Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path)) => {
                Reference::Revision(path.clone(), revision.clone())
            }
            (Against::Revision(_), _) => {
                self.failed("only a project saved in a git repository has revisions");
                return;
            }
        };
        self.progress = Arc::default();
        let job = Job { gpu, project, against, reference, revision, shown, media_dir, trial, run };
        self.worker.submit((job, self.progress.clone()));
    }

    pub fn failed(&mut self, why: &str) {
        self.against = None;
        self.end = Some(Err(why.to_owned()));
    }

    /// Takes a comparison that has ended, and how far one under way has come. Says whether there is something new.
    pub fn take(&mut self) -> bool {
        match self.worker.take() {
            None => {
                let done = self.progress.done.load(Ordering::Relaxed);
                return std::mem::replace(&mut self.told, done) != done;
            }
            Some(Ok(Some(end))) if self.against.is_some() => self.end = Some(end),
            // Nobody wants it any more.
            Some(Ok(_)) => {}
            Some(Err(Panicked(why))) => {
                self.failed(&format!("this is a bug in Eddy: the comparison failed ({why})"));
            }
        }
        if !self.is_due {
            self.against = None;
        }
        true
    }

    pub fn view(&self) -> ComparisonView<'_> {
        if self.against.is_some() {
            let count = |count: &AtomicUsize| count.load(Ordering::Relaxed);
            return Some(Compared::UnderWay { done: count(&self.progress.done), of: count(&self.progress.of) });
        }
        let end = self.end.as_ref()?;
        Some(Compared::Ended(end.as_ref().map_err(String::as_str)))
    }

    /// Waits until the comparison has ended its frame, but not for long. False if it goes on: then nobody waits for its
    /// thread any more.
    pub fn rest(&mut self, patience: Duration) -> bool {
        self.want(None);
        let end = Instant::now() + patience;
        while self.worker.is_busy() {
            if Instant::now() >= end {
                self.worker.leave();
                return false;
            }
            std::thread::sleep(Duration::from_millis(2));
            self.take();
        }
        true
    }
}
