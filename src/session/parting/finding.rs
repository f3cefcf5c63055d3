//! The search that a person asks for of the pixel that is traced: its frame is drawn again beside the picture, on a
//! thread of its own.

use super::{
    assignment::assignments,
    probes::Probes,
    search::{Parted, search},
};
use crate::{
    trace::{Extent, STEPS, Traced},
    worker::{Panicked, Worker},
};
use eddy_engine::{BuildOptions, Engine, FrameInputs, Program, Snapshot, Sources};
use eddy_gpu::Gpu;
use eddy_media as media;
use eddy_project::{CustomUniformValues, PassId};
use std::{path::PathBuf, sync::Arc};

/// Values of the device that are drawn at most: each is a program to compile.
pub const MOST: usize = 48;
/// Steps of the walk that are looked at: half a minute of a person's time is not enough for more.
pub const STEPS_KEPT: usize = 200_000;

/// Says how a search for the place where the device parts stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PartingView<'s> {
    UnderWay,
    Ended(&'s Result<Parted, String>),
}

/// A traced pixel, and the frames that lead to it.
pub(crate) struct PartingJob {
    pub gpu: Gpu,
    pub traced: Arc<Traced>,
    pub shown: PassId,
    pub size: (u32, u32),
    pub media_dir: Option<PathBuf>,
    /// The targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    /// The last one is the traced one.
    pub frames: Vec<(FrameInputs, CustomUniformValues)>,
}

/// A search, if somebody has asked for one.
pub(crate) struct Finding {
    worker: Worker<PartingJob, (Arc<Traced>, Result<Parted, String>)>,
    /// The frames are to be handed out.
    is_due: bool,
    /// Holds what the search is of.
    of: Option<Arc<Traced>>,
    end: Option<Result<Parted, String>>,
}

impl Finding {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let worker = Worker::new("parting", wake, |job: PartingJob| (job.traced.clone(), found(job)))?;
        Ok(Self { worker, is_due: false, of: None, end: None })
    }

    /// Begins a search for a traced pixel.
    pub fn want(&mut self, traced: Option<&Arc<Traced>>) {
        (self.of, self.end) = (traced.cloned(), None);
        self.is_due = traced.is_some();
    }

    /// Another project is open.
    pub fn forget(&mut self) {
        self.want(None);
        self.worker.forget();
    }

    /// The frames are to be handed out now.
    pub fn take_due(&mut self) -> bool {
        std::mem::take(&mut self.is_due)
    }

    /// The pixel that the search is of.
    pub fn of(&self) -> Option<Arc<Traced>> {
        self.of.clone()
    }

    pub fn submit(&mut self, job: PartingJob) {
        self.worker.submit(job);
    }

    pub fn failed(&mut self, why: &str) {
        self.end = Some(Err(why.to_owned()));
    }

    /// Takes a search that has ended. Says whether one has.
    pub fn take(&mut self) -> bool {
        match self.worker.take() {
            None => return false,
            Some(Ok((traced, end))) => {
                // Another one may be asked for by now.
                if self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, &traced)) {
                    self.end = Some(end);
                }
            }
            Some(Err(Panicked(why))) => self.failed(&format!("this is a bug in Eddy: the search failed ({why})")),
        }
        true
    }

    /// The search for a traced pixel; `None`: nobody has asked for one.
    pub fn view(&self, traced: &Arc<Traced>) -> Option<PartingView<'_>> {
        self.of.as_ref().filter(|of| Arc::ptr_eq(of, traced))?;
        Some(self.end.as_ref().map_or(PartingView::UnderWay, PartingView::Ended))
    }
}

fn found(job: PartingJob) -> Result<Parted, String> {
    let PartingJob { gpu, traced, shown, size, media_dir, snapshot, mut frames } = job;
    let (project, pass) = (&traced.project, &traced.pass);
    let Some((inputs, values)) = frames.pop().filter(|(inputs, _)| inputs.frame == traced.frame) else {
        return Err("the shown frame has changed: trace the pixel again".into());
    };
    let (media, _) = media::gather(project, media_dir.as_deref());
    let mut wanted = vec![PassId::Image];
    wanted.extend((shown != PassId::Image && project.pass(&shown).is_some()).then_some(shown));
    let options = BuildOptions { wanted, ..BuildOptions::default() };
    let built = Program::build(&gpu, project, &media, &options).map_err(|e| e.to_string())?;
    let mut engine = Engine::new(gpu, size.0, size.1).map_err(|e| e.to_string())?;
    engine.set_program(built.program).map_err(|e| e.to_string())?;
    if !engine.restore(&snapshot) {
        return Err("the kept frames belong to another program: draw a frame and trace the pixel again".into());
    }
    for (inputs, values) in &frames {
        engine.set_custom_uniforms(values);
        engine.draw(inputs).map_err(|e| e.to_string())?;
    }
    let trace = traced.trace(Extent { statements: STEPS, steps: STEPS_KEPT }).map_err(|e| e.to_string())?;
    let assignments = assignments(&Sources::new(project), traced.index(), &trace);
    let before = engine.snapshot().map_err(|e| e.to_string())?;
    let mut probes = Probes::new((engine, before), (project, &media), options, pass.clone(), (inputs, values));
    search(assignments, MOST, |assignment| probes.value(assignment, traced.pixel)).map_err(|e| e.to_string())
}
