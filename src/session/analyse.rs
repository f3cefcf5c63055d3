//! A session has the tab in front analysed after each change, and answers a front end from the newest analysis.

use super::{
    Session,
    analysis::{COMMON, TabAnalysis, Texts},
};
use crate::{
    diag::{SourceId, Span},
    engine,
    project::{PassId, Project, Stage, Tab},
};
use std::{ops::Range, sync::Arc};

impl Session {
    /// Returns the newest analysis of the tab in front, which may be of an older text.
    pub fn analysis(&self) -> Option<&Arc<TabAnalysis>> {
        self.analyst.newest.as_ref()
    }

    /// Every place in the project where what a place of `of` stands for is named. What is declared in Common is looked
    /// for in every pass, which takes about a millisecond for a thousand lines.
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
        // Included files are read with what includes them: as before, if that does.
        let read_with = match &tab {
            Tab::Included(_) => {
                let users = self.project().tabs_that_include(&tab);
                let is_known = |user: &Tab| user.pass().is_none_or(|id| *id == self.analyst.pass);
                users.iter().find(|user| is_known(user)).or(users.first()).cloned().unwrap_or(Tab::Common)
            }
            _ => tab.clone(),
        };
        if let Some(id) = read_with.pass() {
            self.analyst.pass = id.clone();
        }
        self.analyst.stage = match read_with {
            Tab::Stage(_, file) => Some(file),
            Tab::Common | Tab::Pass(_) | Tab::Included(_) => None,
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
