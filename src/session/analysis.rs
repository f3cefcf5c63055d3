//! The texts as an editor understands them: the tab in front with its Common, analysed anew after each change, on a
//! thread of its own so that no keystroke waits for it.

use super::worker::Worker;
use eddy_diag::SourceId;
use eddy_engine::{self as engine, KeptPreamble, Sources};
use eddy_glsl::services::{Analysis, ClassSpan};
use eddy_project::{Pass, PassId, Project, Stage, Tab};
use std::sync::Arc;

pub(super) const COMMON: SourceId = Project::COMMON_ID;

/// The answers that an editor can have about a tab; see [`Analysis`].
#[derive(Debug)]
pub struct TabAnalysis {
    pub analysis: Analysis,
    /// The tab that was in front, and the colours of its text.
    pub front: Tab,
    pub classes: Vec<ClassSpan>,
    pub(super) texts: Texts,
}

/// One pass of a project.
#[derive(Clone, Debug)]
pub(super) struct Texts {
    project: Project,
    index: usize,
    /// The text of the pass that is read.
    stage: Stage,
}

impl Texts {
    pub fn of(project: &Project, index: usize, stage: Stage) -> Self {
        Self { project: project.clone(), index, stage }
    }

    pub fn pass(&self) -> &Pass {
        &self.project.passes[self.index]
    }

    fn code(&self) -> SourceId {
        self.project.stage_id(self.index, self.stage)
    }

    /// Returns whether nothing has changed. Texts are shared until they are edited, so looking at where they are is
    /// enough.
    pub fn is_same(&self, other: &Self) -> bool {
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

    /// Analyses them, with Common as it was read last where it is the same.
    fn analyse(&self, preamble: &mut KeptPreamble) -> Analysis {
        let sources = Sources::new(&self.project);
        preamble.lend(&sources);
        let analysis = sources.analyse_stage(self.index, self.stage);
        preamble.keep(&sources);
        analysis
    }
}

impl TabAnalysis {
    /// The source of a tab in [`TabAnalysis::analysis`]; `None` for a tab it knows nothing of.
    pub fn source_of(&self, tab: &Tab) -> Option<SourceId> {
        match tab {
            Tab::Common => self.texts.project.common.as_ref().map(|_| COMMON),
            Tab::Included(_) => {
                let id = self.texts.project.id_of(tab)?;
                self.analysis.text(id).map(|_| id)
            }
            Tab::Pass(_) | Tab::Stage(..) => {
                let code = self.texts.code();
                (self.texts.project.tab_of(code).as_ref() == Some(tab)).then_some(code)
            }
        }
    }

    /// Returns the tab of a text; `None` for one that the project does not have.
    pub fn tab_of(&self, source: SourceId) -> Option<Tab> {
        self.texts.project.tab_of(source)
    }

    /// The text of the tab in front that the answers are about: where it is not the editor's, it is older.
    pub fn text(&self) -> &Arc<str> {
        match &self.front {
            Tab::Common => self.texts.project.common.as_ref().map_or(&self.texts.pass().source.text, |c| &c.text),
            Tab::Pass(_) => &self.texts.pass().source.text,
            Tab::Stage(..) | Tab::Included(_) => {
                let source = self.texts.project.source(&self.front);
                source.map_or(&self.texts.pass().source.text, |s| &s.text)
            }
        }
    }
}

/// The analyst at work.
pub(super) struct Analyst {
    pub worker: Worker<(Texts, Tab), TabAnalysis>,
    pub front: Option<Tab>,
    /// The pass that Common is read with.
    pub pass: PassId,
    /// And the stage of it.
    pub stage: Option<String>,
    pub asked: Option<(Texts, Tab)>,
    pub newest: Option<Arc<TabAnalysis>>,
}

impl Analyst {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let mut preamble = KeptPreamble::default();
        let work = move |(texts, front): (Texts, Tab)| {
            let analysis = texts.analyse(&mut preamble);
            let own = match &front {
                Tab::Common => COMMON,
                Tab::Included(_) => texts.project.id_of(&front).unwrap_or(texts.code()),
                Tab::Pass(_) | Tab::Stage(..) => texts.code(),
            };
            let classes = analysis.classes(own);
            TabAnalysis { analysis, front, classes, texts }
        };
        let worker = Worker::new("analysis", wake, work)?;
        Ok(Self { worker, front: None, pass: PassId::Image, stage: None, asked: None, newest: None })
    }
}
