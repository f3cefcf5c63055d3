//! Editor analysis of the project's texts: the front tab with its Common is re-analysed after each change, on a thread
//! of its own so that no keystroke waits for it.

use super::{open_project::OpenProject, rename};
use eddy_background::Background;
use eddy_diag::SourceId;
use eddy_engine::{self as engine, PreambleCache, Sources};
use eddy_glsl::services::{Analysis, ClassSpan};
use eddy_project::{Pass, PassName, Project, Stage, Tab};
use std::{collections::BTreeSet, ops::Range, sync::Arc};

pub(super) const COMMON: SourceId = Project::COMMON_ID;

/// The editor's answers about a tab; see [`Analysis`].
#[derive(Debug)]
pub struct TabAnalysis {
    pub analysis: Analysis,
    /// The tab that was in front, and the syntax classes of its text.
    pub front: Tab,
    pub classes: Vec<ClassSpan>,
    pub(super) texts: Texts,
}

/// One pass of a project.
#[derive(Clone, Debug)]
pub(super) struct Texts {
    project: Project,
    index: usize,
    /// The stage whose text is analysed.
    stage: Stage,
}

impl Texts {
    pub(crate) fn of(project: &Project, index: usize, stage: Stage) -> Self {
        Self { project: project.clone(), index, stage }
    }

    pub(crate) fn pass(&self) -> &Pass {
        &self.project.passes[self.index]
    }

    fn code(&self) -> SourceId {
        self.project.stage_id(self.index, self.stage)
    }

    /// Returns whether nothing has changed. Texts are shared until they are edited, so comparing pointers is enough.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
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
            && self.pass().body == other.pass().body
            && engine::channel_kinds(self.pass()) == engine::channel_kinds(other.pass())
    }

    /// Analyses the texts, reusing the last analysis of Common if Common is the same.
    fn analyse(&self, preamble: &mut PreambleCache) -> Analysis {
        let sources = Sources::new(&self.project);
        preamble.provide_to(&sources);
        let analysis = sources.analyse_stage(self.index, self.stage);
        preamble.update_from(&sources);
        analysis
    }
}

impl TabAnalysis {
    /// The source of a tab in [`TabAnalysis::analysis`]; `None` for a tab that was not analysed.
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

    /// The text of the front tab that was analysed: older than the editor's if the two differ.
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

/// The background analysis and its input.
pub(super) struct Analyst {
    pub background: Background<(Texts, Tab), (), TabAnalysis>,
    pub front: Option<Tab>,
    /// The pass that Common is analysed with.
    pub pass: PassName,
    /// The stage of that pass.
    pub stage: Option<String>,
    pub asked: Option<(Texts, Tab)>,
    pub newest: Option<Arc<TabAnalysis>>,
}

impl Analyst {
    pub(crate) fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let mut preamble = PreambleCache::default();
        let work = move |(texts, front): (Texts, Tab), _: &_| {
            let analysis = texts.analyse(&mut preamble);
            let own = match &front {
                Tab::Common => COMMON,
                Tab::Included(_) => texts.project.id_of(&front).unwrap_or(texts.code()),
                Tab::Pass(_) | Tab::Stage(..) => texts.code(),
            };
            let classes = analysis.classes(own);
            Ok(TabAnalysis { analysis, front, classes, texts })
        };
        let background = Background::new("analysis", "the analysis", wake, work)?;
        Ok(Self { background, front: None, pass: PassName::image(), stage: None, asked: None, newest: None })
    }
}

impl OpenProject {
    /// Every place in the project that names the symbol at a place of `of`. A symbol that is declared in a text shared
    /// by several passes is searched for in every pass, which takes about a millisecond for a thousand lines.
    pub(crate) fn uses(&self, of: &TabAnalysis, source: SourceId, offset: usize) -> Vec<(Tab, Range<usize>)> {
        let project = self.project();
        let here = of.analysis.uses(source, offset);
        let declared = of.analysis.definition(source, offset);
        let is_shared = |id: SourceId| id == COMMON || matches!(project.tab_of(id), Some(Tab::Included(_)));
        let mut places: Vec<(SourceId, Range<usize>)> = here.iter().map(|s| (s.source, s.range())).collect();
        let is_uniform = of.analysis.custom_uniform_at(source, offset).is_some()
            || project.custom_uniform_names().iter().any(|(_, s)| s.source == source && s.range().contains(&offset));
        let uniform = is_uniform.then_some((source, offset));
        let shared = declared.filter(|s| is_shared(s.source)).map(|s| (s.source, s.start as usize));
        if let Some((source, at)) = uniform.or(shared) {
            let all = rename::everywhere(project, source, at);
            let all = all.into_iter().map(|(id, start, end)| (id, start as usize..end as usize));
            places.extend(all);
        }
        // Uses in the front pass come first, in their own order.
        let mut known = BTreeSet::new();
        places.retain(|(id, range)| known.insert((id.0, range.start)));
        places.into_iter().filter_map(|(id, range)| Some((project.tab_of(id)?, range))).collect()
    }
}

impl Analyst {
    /// Returns the newest analysis of the front tab, which may be of an older text.
    pub(crate) fn analysis(&self) -> Option<&Arc<TabAnalysis>> {
        self.newest.as_ref()
    }

    /// Returns the line, from 0, at which a breakpoint in a line of a tab stops: its own, or the next one with a
    /// statement. `None` if no statement follows. Parses the text again, which takes about a millisecond for a thousand
    /// lines.
    pub(crate) fn stop_line(&self, open: &OpenProject, tab: &Tab, line: usize) -> Option<usize> {
        let project = open.project();
        let text = open.text(tab);
        let id = project.id_of(tab)?;
        let (index, stage) = self.read_with(open, tab)?;
        let start = text.split_inclusive('\n').take(line).map(str::len).sum::<usize>();
        let end = text[start..].find('\n').map_or(text.len(), |at| start + at + 1);
        let analysis = engine::Sources::new(project).analyse_stage(index, stage);
        let at = analysis.statement_for(id, start..end.max(start + 1))?;
        Some(text.get(..at)?.matches('\n').count())
    }

    /// Returns the pass and the stage that a tab is analysed with: its own, or for a shared text one of those that
    /// include it.
    fn read_with(&self, open: &OpenProject, tab: &Tab) -> Option<(usize, Stage)> {
        let project = open.project();
        let users = match tab {
            Tab::Included(_) => project.tabs_that_include(tab),
            _ => vec![tab.clone()],
        };
        let is_known = |user: &&Tab| user.pass().is_none_or(|id| *id == self.pass);
        let user = users.iter().find(is_known).or(users.first())?;
        let place = |id: &PassName| project.passes.iter().position(|p| p.id == *id);
        let index = match user.pass() {
            Some(id) => place(id)?,
            None => place(&self.pass).or_else(|| place(&PassName::image()))?,
        };
        let stages = project.passes[index].body.stages();
        let file = match user {
            Tab::Stage(_, file) => Some(file),
            _ => None,
        };
        Some((index, stages.iter().position(|s| Some(&s.name) == file).map_or(Stage::Own, Stage::File)))
    }

    /// Sets the tab whose text is analysed from now on.
    pub(super) fn bring_to_front(&mut self, open: &mut OpenProject, tab: Tab) {
        if let Some((index, stage)) = self.read_with(open, &tab).filter(|_| tab != Tab::Common) {
            let pass = &open.documents.current().passes[index];
            self.pass = pass.id.clone();
            let stages = pass.body.stages();
            self.stage = match stage {
                Stage::Own => None,
                Stage::File(n) => stages.get(n).map(|s| s.name.clone()),
            };
        } else {
            self.stage = None;
        }
        self.front = Some(tab);
    }

    /// Submits the newest texts for analysis if they have changed.
    pub(super) fn analyse(&mut self, open: &mut OpenProject) {
        let Some(front) = self.front.clone() else { return };
        let project = open.documents.current();
        let place = |id: &PassName| project.passes.iter().position(|p| p.id == *id);
        let index = place(&self.pass).or_else(|| place(&PassName::image())).unwrap_or(0);
        if project.passes.is_empty() {
            return;
        }
        let stages = project.passes[index].body.stages();
        let file = self.stage.as_ref();
        let stage = stages.iter().position(|s| Some(&s.name) == file).map_or(Stage::Own, Stage::File);
        let texts = Texts::of(project, index, stage);
        let is_known = self.asked.as_ref().is_some_and(|(old, tab)| *tab == front && old.is_same(&texts));
        if !is_known {
            self.asked = Some((texts.clone(), front.clone()));
            self.background.start((texts, front));
        }
    }

    pub(super) fn take_analysed(&mut self, open: &mut OpenProject) {
        match self.background.take() {
            None => return,
            Some(Ok(done)) => self.newest = Some(Arc::new(done)),
            // The editor works without an analysis; the compiler reports the bug to the user if it panics as well.
            Some(Err(why)) => log::error!("{why}"),
        }
        open.host.changed = true;
    }
}
