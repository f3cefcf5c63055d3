//! The search for the first NaN among the frames that are kept: drawn once more beside the picture, which goes on.

use super::texels::{NonfiniteTexels, born, drawn, stored};
use crate::{
    trace::STEPS,
    view::Place,
    worker::{Panicked, Worker},
};
use eddy_diag::Span;
use eddy_engine::{BuildOptions, Engine, FrameInputs, Program, Snapshot};
use eddy_gpu::Gpu;
use eddy_media as media;
use eddy_project::{CustomUniformValues, PassId, Project};
use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

/// The first texels that are no finite numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstNonfinite {
    pub pass: PassId,
    pub frame: i32,
    /// The first from the bottom left, and how many there are of the pass in that frame.
    pub texel: (u32, u32),
    pub value: [f32; 4],
    pub texels: usize,
    /// They are older than the frames that are kept, of which this is the oldest.
    pub is_older: bool,
    /// The operation; `None` where nothing but the pass's format or a texel that it reads can have made it.
    pub born: Option<BornAt>,
}

/// An operation that makes what is no finite number.
#[derive(Clone, Debug, PartialEq)]
pub struct BornAt {
    pub message: &'static str,
    /// `None` for what Eddy adds to the author's code.
    pub place: Option<Place>,
    /// The text that the author wrote there, its first line.
    pub text: String,
    /// The numbers there, as in `pow(-0.5, 2)`.
    pub numbers: String,
}

/// Says how a search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum SearchEnd {
    Found(Box<FirstNonfinite>),
    /// Every texel is finite in the frames from the one to the other.
    Nowhere {
        first: i32,
        last: i32,
    },
    Failed(String),
}

/// A search, from its begin on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Search<'s> {
    /// So many frames have been looked through, of so many.
    UnderWay {
        done: usize,
        of: usize,
    },
    Ended(&'s SearchEnd),
}

/// The state that a front end shows of it; `None` before the first.
pub type SearchView<'s> = Option<Search<'s>>;

/// Frames, and what they are drawn by.
pub(crate) struct SearchJob {
    pub gpu: Gpu,
    pub project: Project,
    pub shown: PassId,
    pub size: (u32, u32),
    pub media_dir: Option<PathBuf>,
    /// The targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    pub frames: Vec<(FrameInputs, CustomUniformValues)>,
}

#[derive(Default)]
struct Progress {
    done: AtomicUsize,
    is_over: AtomicBool,
}

/// A search, if somebody has asked for one.
pub(crate) struct Searching {
    worker: Worker<(SearchJob, Arc<Progress>), Option<SearchEnd>>,
    /// The frames are to be handed out.
    pub is_due: bool,
    /// Frames of the search under way.
    of: usize,
    progress: Arc<Progress>,
    /// The progress that a front end knows of.
    told: usize,
    end: Option<SearchEnd>,
}

impl Searching {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let tell = wake.clone();
        let work = move |(job, progress): (SearchJob, Arc<Progress>)| search(job, &progress, &*tell);
        let worker = Worker::new("first NaN", wake, work)?;
        Ok(Self { worker, is_due: false, of: 0, progress: Arc::default(), told: 0, end: None })
    }

    /// Begins anew, or ends.
    pub fn want(&mut self, is_wanted: bool) {
        self.progress.is_over.store(true, Ordering::Relaxed);
        (self.is_due, self.end, self.of) = (is_wanted, None, 0);
    }

    /// Another project is open.
    pub fn forget(&mut self) {
        self.want(false);
        self.worker.forget();
    }

    pub fn submit(&mut self, job: SearchJob) {
        self.progress = Arc::default();
        self.of = job.frames.len();
        self.worker.submit((job, self.progress.clone()));
    }

    pub fn failed(&mut self, why: &str) {
        self.end = Some(SearchEnd::Failed(why.to_owned()));
    }

    /// Takes a search that has ended, and how far one under way has come. Says whether there is something new.
    pub fn take(&mut self) -> bool {
        match self.worker.take() {
            None => {
                let done = self.progress.done.load(Ordering::Relaxed);
                return std::mem::replace(&mut self.told, done) != done;
            }
            Some(Ok(end)) => self.end = end.or(self.end.take()),
            Some(Err(Panicked(why))) => self.failed(&format!("this is a bug in Eddy: the search failed ({why})")),
        }
        self.of = 0;
        true
    }

    pub fn view(&self) -> SearchView<'_> {
        if self.is_due || self.of > 0 {
            return Some(Search::UnderWay { done: self.progress.done.load(Ordering::Relaxed), of: self.of });
        }
        self.end.as_ref().map(Search::Ended)
    }
}

impl Drop for Searching {
    fn drop(&mut self) {
        // The thread is waited for.
        self.progress.is_over.store(true, Ordering::Relaxed);
    }
}

/// `None`: nobody wants it any more.
fn search(job: SearchJob, progress: &Progress, tell: &dyn Fn()) -> Option<SearchEnd> {
    let SearchJob { gpu, project, shown, size, media_dir, snapshot, frames } = job;
    let failed = |why: String| Some(SearchEnd::Failed(why));
    let (media, _) = media::gather(&project, media_dir.as_deref());
    let mut wanted = vec![PassId::Image];
    wanted.extend((shown != PassId::Image && project.pass(&shown).is_some()).then_some(shown));
    let options = BuildOptions { wanted, ..BuildOptions::default() };
    let built = match Program::build(&gpu, &project, &media, &options) {
        Ok(built) => built,
        Err(e) => return failed(e.to_string()),
    };
    let set = Engine::new(gpu, size.0, size.1).and_then(|mut engine| {
        engine.set_program(built.program)?;
        Ok(engine)
    });
    let mut engine = match set {
        Ok(engine) => engine,
        Err(e) => return failed(e.to_string()),
    };
    if !engine.restore(&snapshot) {
        return failed("the kept frames belong to another program: reset and search again".into());
    }
    let passes = drawn(&project);
    let first = frames.first().map_or(0, |(inputs, _)| inputs.frame);
    if let Some(found) = look(&mut engine, &project, &passes, first - 1) {
        return Some(SearchEnd::Found(Box::new(FirstNonfinite { is_older: true, ..found })));
    }
    for (inputs, values) in &frames {
        if progress.is_over.load(Ordering::Relaxed) {
            return None;
        }
        engine.set_custom_uniforms(values);
        if let Err(e) = engine.draw(inputs) {
            return failed(e.to_string());
        }
        if let Some(found) = look(&mut engine, &project, &passes, inputs.frame) {
            let born = match engine.inspect(&found.pass) {
                Ok(read) => match born(&project, &found.pass, &read, found.texel, STEPS) {
                    Ok(finding) => finding,
                    Err(e) => return failed(e.to_string()),
                },
                Err(e) => return failed(e.to_string()),
            };
            let born = born.map(|finding| BornAt {
                message: finding.kind.message(),
                place: finding.span.and_then(|span| Place::new(span, &project.sources(), &project)),
                text: finding.span.map_or_else(String::new, |span| written(&project, span)),
                numbers: finding.numbers,
            });
            return Some(SearchEnd::Found(Box::new(FirstNonfinite { born, ..found })));
        }
        progress.done.fetch_add(1, Ordering::Relaxed);
        tell();
    }
    let last = frames.last().map_or(0, |(inputs, _)| inputs.frame);
    Some(SearchEnd::Nowhere { first, last })
}

/// The first pass whose newest texels are not all finite.
fn look(engine: &mut Engine, project: &Project, passes: &[PassId], frame: i32) -> Option<FirstNonfinite> {
    passes.iter().find_map(|pass| {
        // What no picture needs is not drawn, and has no texels.
        let pixels = engine.read(pass).ok()?;
        let NonfiniteTexels { first, count } = NonfiniteTexels::find(&pixels, stored(project, pass))?;
        let value = pixels.texels[(first.1 * pixels.width + first.0) as usize];
        let pass = pass.clone();
        Some(FirstNonfinite { pass, frame, texel: first, value, texels: count, is_older: false, born: None })
    })
}

fn written(project: &Project, span: Span) -> String {
    let sources = project.sources();
    let text = sources.get(span.source).and_then(|source| source.text.get(span.range()));
    text.and_then(|text| text.lines().next()).unwrap_or_default().to_owned()
}
