//! A session has the tab in front analysed after each change, and answers a front end from the newest analysis.

use super::{
    Session,
    analysis::{COMMON, TabAnalysis, Texts},
    rename,
};
use eddy_diag::SourceId;
use eddy_engine as engine;
use eddy_project::{PassId, Stage, Tab};
use std::{collections::BTreeSet, ops::Range, sync::Arc};

impl Session {
    /// Returns the newest analysis of the tab in front, which may be of an older text.
    pub fn analysis(&self) -> Option<&Arc<TabAnalysis>> {
        self.analyst.newest.as_ref()
    }

    /// Every place in the project where what a place of `of` stands for is named. What is declared in a text that several
    /// passes have in them is looked for in every pass, which takes about a millisecond for a thousand lines.
    pub fn uses(&self, of: &TabAnalysis, source: SourceId, offset: usize) -> Vec<(Tab, Range<usize>)> {
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
            let all = all.into_iter().map(|(id, start, end)| (SourceId(id), start as usize..end as usize));
            places.extend(all);
        }
        // What the pass in front has stands first, in its own order.
        let mut known = BTreeSet::new();
        places.retain(|(id, range)| known.insert((id.0, range.start)));
        places.into_iter().filter_map(|(id, range)| Some((project.tab_of(id)?, range))).collect()
    }

    /// Returns the line, from 0, at which a breakpoint in a line of a tab stops: its own, or the next one with a statement.
    /// `None` where none comes any more. Reads the text anew, which takes about a millisecond for a thousand lines.
    pub fn stop_line(&self, tab: &Tab, line: usize) -> Option<usize> {
        let project = self.project();
        let text = self.text(tab);
        let id = project.id_of(tab)?;
        let (index, stage) = self.read_with(tab)?;
        let start = text.split_inclusive('\n').take(line).map(str::len).sum::<usize>();
        let end = text[start..].find('\n').map_or(text.len(), |at| start + at + 1);
        let analysis = engine::Sources::new(project).analyse_stage(index, stage);
        let at = analysis.statement_for(id, start..end.max(start + 1))?;
        Some(text.get(..at)?.matches('\n').count())
    }

    /// Returns the pass, and the stage of it, that a tab is read with: its own, for what several have in them one of those.
    fn read_with(&self, tab: &Tab) -> Option<(usize, Stage)> {
        let project = self.project();
        let users = match tab {
            Tab::Included(_) => project.tabs_that_include(tab),
            _ => vec![tab.clone()],
        };
        let is_known = |user: &&Tab| user.pass().is_none_or(|id| *id == self.analyst.pass);
        let user = users.iter().find(is_known).or(users.first())?;
        let place = |id: &PassId| project.passes.iter().position(|p| p.id == *id);
        let index = match user.pass() {
            Some(id) => place(id)?,
            None => place(&self.analyst.pass).or_else(|| place(&PassId::Image))?,
        };
        let stages = project.passes[index].settings.meshes().map_or(&[][..], |g| &g.stages);
        let file = match user {
            Tab::Stage(_, file) => Some(file),
            _ => None,
        };
        Some((index, stages.iter().position(|s| Some(&s.name) == file).map_or(Stage::Own, Stage::File)))
    }

    /// The tab whose text is analysed from now on.
    pub(super) fn bring_to_front(&mut self, tab: Tab) {
        if let Some((index, stage)) = self.read_with(&tab).filter(|_| tab != Tab::Common) {
            let pass = &self.documents.current().passes[index];
            self.analyst.pass = pass.id.clone();
            let stages = pass.settings.meshes().map_or(&[][..], |g| &g.stages);
            self.analyst.stage = match stage {
                Stage::Own => None,
                Stage::File(n) => stages.get(n).map(|s| s.name.clone()),
            };
        } else {
            self.analyst.stage = None;
        }
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
            Some(Err(panicked)) => log::error!("this is a bug in Eddy: the analysis failed ({})", panicked.0),
        }
        self.changed = true;
    }
}
