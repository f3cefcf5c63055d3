//! The texts as an editor understands them: the tab in front with its Common, analysed anew after each change, on a thread
//! of its own so that no keystroke waits for it.

use super::{Session, worker::Worker};
use crate::{
    diag::{SourceId, Span},
    engine,
    glsl::services::{Analysis, ClassSpan},
    project::{Pass, PassId, Project, Stage, Tab},
};
use std::{ops::Range, sync::Arc};

const COMMON: SourceId = Project::COMMON_ID;

/// What an editor can ask of a tab; see [`Analysis`].
#[derive(Debug)]
pub struct TabAnalysis {
    pub analysis: Analysis,
    /// The tab that was in front, and the colours of its text.
    pub front: Tab,
    pub classes: Vec<ClassSpan>,
    texts: Texts,
}

/// One pass of a project.
#[derive(Clone, Debug)]
struct Texts {
    project: Project,
    index: usize,
    /// Of the pass's texts, the one that is read.
    stage: Stage,
}

impl Texts {
    fn of(project: &Project, index: usize, stage: Stage) -> Self {
        Self { project: project.clone(), index, stage }
    }

    fn pass(&self) -> &Pass {
        &self.project.passes[self.index]
    }

    fn code(&self) -> SourceId {
        self.project.stage_id(self.index, self.stage)
    }

    /// Whether nothing has changed. Texts are shared until they are edited, so looking at where they are is enough.
    fn is_same(&self, other: &Self) -> bool {
        let all = |p: &Project| -> Vec<Arc<str>> {
            let texts = p.tab_sources();
            texts.chain(p.includes.iter().map(|i| &i.source)).map(|s| s.text.clone()).collect()
        };
        let (mine, theirs) = (all(&self.project), all(&other.project));
        self.project.common.is_some() == other.project.common.is_some()
            && mine.len() == theirs.len()
            && mine.iter().zip(&theirs).all(|(a, b)| Arc::ptr_eq(a, b))
            && self.pass().id == other.pass().id
            && self.stage == other.stage
            && self.pass().settings.body == other.pass().settings.body
            && engine::channel_kinds(self.pass()) == engine::channel_kinds(other.pass())
    }

    fn analyse(&self) -> Analysis {
        engine::Sources::new(&self.project).analyse_stage(self.index, self.stage)
    }
}

impl TabAnalysis {
    /// The source of a tab in [`TabAnalysis::analysis`]; `None` for a tab it knows nothing of.
    pub fn source_of(&self, tab: &Tab) -> Option<SourceId> {
        match tab {
            Tab::Common => self.texts.project.common.as_ref().map(|_| COMMON),
            Tab::Pass(_) | Tab::Stage(..) => {
                let code = self.texts.code();
                (self.texts.project.tab_of(code).as_ref() == Some(tab)).then_some(code)
            }
        }
    }

    /// `None`: an included file, which has no tab.
    pub fn tab_of(&self, source: SourceId) -> Option<Tab> {
        self.texts.project.tab_of(source)
    }

    /// The text of the tab in front that the answers are about: where it is not the editor's, it is older.
    pub fn text(&self) -> &Arc<str> {
        match &self.front {
            Tab::Common => self.texts.project.common.as_ref().map_or(&self.texts.pass().source.text, |c| &c.text),
            Tab::Pass(_) => &self.texts.pass().source.text,
            Tab::Stage(..) => {
                let source = self.texts.project.source(&self.front);
                source.map_or(&self.texts.pass().source.text, |s| &s.text)
            }
        }
    }
}

/// The analyst at work.
pub(super) struct Analyst {
    worker: Worker<(Texts, Tab), TabAnalysis>,
    front: Option<Tab>,
    /// The pass that Common is read with.
    pass: PassId,
    /// And the stage of it.
    stage: Option<String>,
    asked: Option<(Texts, Tab)>,
    newest: Option<Arc<TabAnalysis>>,
}

impl Analyst {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let work = |(texts, front): (Texts, Tab)| {
            let analysis = texts.analyse();
            let classes = analysis.classes(if front == Tab::Common { COMMON } else { texts.code() });
            TabAnalysis { analysis, front, classes, texts }
        };
        let worker = Worker::new("analysis", wake, work)?;
        Ok(Self { worker, front: None, pass: PassId::Image, stage: None, asked: None, newest: None })
    }
}

impl Session {
    /// Of the tab in front, the newest there is; may be of an older text.
    pub fn analysis(&self) -> Option<&Arc<TabAnalysis>> {
        self.analyst.newest.as_ref()
    }

    /// Every place in the project where what a place of `of` stands for is named. What is declared in Common is looked for in
    /// every pass, which takes about a millisecond for a thousand lines.
    pub fn uses(&self, of: &TabAnalysis, source: SourceId, offset: usize) -> Vec<(Tab, Range<usize>)> {
        let here = of.analysis.uses(source, offset);
        let mut found: Vec<(Tab, Range<usize>)> =
            here.iter().filter_map(|s| Some((of.tab_of(s.source)?, s.range()))).collect();
        let declared = of.analysis.definition(source, offset);
        let shared: Option<Span> = here.iter().copied().find(|s| s.source == COMMON).or(declared);
        if let Some(shared) = shared.filter(|s| s.source == COMMON) {
            let project = self.project();
            let texts = engine::Sources::new(project);
            for (index, pass) in project.passes.iter().enumerate().filter(|(_, p)| p.id != of.texts.pass().id) {
                let uses = texts.analyse(index).uses(COMMON, shared.start as usize);
                let there = uses.iter().filter(|s| s.source == Project::pass_id(index));
                found.extend(there.map(|s| (Tab::Pass(pass.id.clone()), s.range())));
                for n in 0..pass.settings.meshes().map_or(0, |g| g.stages.len()) {
                    let id = project.stage_id(index, Stage::File(n));
                    let uses = texts.analyse_stage(index, Stage::File(n)).uses(COMMON, shared.start as usize);
                    let there = uses.iter().filter(|s| s.source == id);
                    found.extend(there.filter_map(|s| Some((project.tab_of(id)?, s.range()))));
                }
            }
        }
        found
    }

    /// The tab whose text is analysed from now on.
    pub(super) fn bring_to_front(&mut self, tab: Tab) {
        if let Some(id) = tab.pass() {
            self.analyst.pass = id.clone();
        }
        self.analyst.stage = match &tab {
            Tab::Stage(_, file) => Some(file.clone()),
            Tab::Common | Tab::Pass(_) => None,
        };
        self.analyst.front = Some(tab);
    }

    /// Hands the newest texts to the analyst if they are new to it.
    pub(super) fn analyse(&mut self) {
        let Some(front) = self.analyst.front.clone() else { return };
        let project = self.documents.current();
        let place = |id: &PassId| project.passes.iter().position(|p| p.id == *id);
        let index = place(&self.analyst.pass).or_else(|| place(&PassId::Image)).unwrap_or(0);
        if project.passes.is_empty() {
            return;
        }
        let stages = project.passes[index].settings.meshes().map_or(&[][..], |g| &g.stages);
        let file = self.analyst.stage.as_ref();
        let stage = stages.iter().position(|s| Some(&s.name) == file).map_or(Stage::Own, Stage::File);
        let texts = Texts::of(project, index, stage);
        let is_known = self.analyst.asked.as_ref().is_some_and(|(old, tab)| *tab == front && old.is_same(&texts));
        if !is_known {
            self.analyst.asked = Some((texts.clone(), front.clone()));
            self.analyst.worker.submit((texts, front));
        }
    }

    pub(super) fn take_analysed(&mut self) {
        match self.analyst.worker.take() {
            None => return,
            Some(Ok(done)) => self.analyst.newest = Some(Arc::new(done)),
            // The editor does without; the compiler will say so aloud if it stumbles as well.
            Some(Err(panicked)) => log::error!("this is a bug in Eddy: the analysis gave up ({})", panicked.0),
        }
        self.changed = true;
    }
}
