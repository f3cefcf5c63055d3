//! The texts as an editor understands them: the tab in front with its Common, analysed anew after each change, on a thread
//! of its own so that no keystroke waits for it.

use super::{Session, worker::Worker};
use crate::{
    diag::{SourceId, Span},
    engine,
    glsl::{
        ChannelKind, PassKind, PassSource, Text,
        services::{Analysis, ClassSpan},
    },
    project::{Pass, PassId, Project, Source, Tab},
};
use std::{ops::Range, sync::Arc};

const COMMON: SourceId = SourceId(0);
const CODE: SourceId = SourceId(1);

/// What an editor can ask of a tab; see [`Analysis`].
#[derive(Debug)]
pub struct TabAnalysis {
    pub analysis: Analysis,
    /// The tab that was in front, and the colours of its text.
    pub front: Tab,
    pub classes: Vec<ClassSpan>,
    texts: Texts,
}

/// One pass behind its Common.
#[derive(Clone, Debug)]
struct Texts {
    pass: PassId,
    kind: PassKind,
    channels: [ChannelKind; 4],
    common: Option<Source>,
    code: Source,
}

impl Texts {
    fn of(project: &Project, pass: &Pass) -> Self {
        Self {
            pass: pass.id.clone(),
            kind: engine::pass_kind(&pass.id),
            channels: engine::channel_kinds(pass),
            common: project.common.clone(),
            code: pass.source.clone(),
        }
    }

    /// Whether nothing has changed. Texts are shared until they are edited, so looking at where they are is enough.
    fn is_same(&self, other: &Self) -> bool {
        let text = |s: &Source| s.text.clone();
        let same = |a: &Arc<str>, b: &Arc<str>| Arc::ptr_eq(a, b);
        let common = match (self.common.as_ref().map(text), other.common.as_ref().map(text)) {
            (Some(a), Some(b)) => same(&a, &b),
            (a, b) => a.is_none() == b.is_none(),
        };
        common && same(&self.code.text, &other.code.text) && self.pass == other.pass && self.channels == other.channels
    }

    fn analyse(&self) -> Analysis {
        let common = self.common.as_ref().map(Source::compile_text);
        let code = self.code.compile_text();
        Analysis::new(&PassSource {
            kind: self.kind,
            common: common.as_deref().map(|text| Text { id: COMMON, text }),
            code: Text { id: CODE, text: &code },
            channels: self.channels,
            bilinear_by_hand: [false; 4],
            tables_in_memory: false,
        })
    }
}

impl TabAnalysis {
    /// The source of a tab in [`TabAnalysis::analysis`]; `None` for a tab it knows nothing of.
    pub fn source_of(&self, tab: &Tab) -> Option<SourceId> {
        match tab {
            Tab::Common => self.texts.common.as_ref().map(|_| COMMON),
            Tab::Pass(id) => (*id == self.texts.pass).then_some(CODE),
        }
    }

    pub fn tab_of(&self, source: SourceId) -> Tab {
        if source == COMMON { Tab::Common } else { Tab::Pass(self.texts.pass.clone()) }
    }

    /// The text of the tab in front that the answers are about: where it is not the editor's, it is older.
    pub fn text(&self) -> &Arc<str> {
        match &self.front {
            Tab::Common => self.texts.common.as_ref().map_or(&self.texts.code.text, |common| &common.text),
            Tab::Pass(_) => &self.texts.code.text,
        }
    }
}

/// The analyst at work.
pub(super) struct Analyst {
    worker: Worker<(Texts, Tab), TabAnalysis>,
    front: Option<Tab>,
    /// The pass that Common is read with.
    pass: PassId,
    asked: Option<(Texts, Tab)>,
    newest: Option<Arc<TabAnalysis>>,
}

impl Analyst {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let work = |(texts, front): (Texts, Tab)| {
            let analysis = texts.analyse();
            let classes = analysis.classes(if front == Tab::Common { COMMON } else { CODE });
            TabAnalysis { analysis, front, classes, texts }
        };
        let worker = Worker::new("analysis", wake, work)?;
        Ok(Self { worker, front: None, pass: PassId::Image, asked: None, newest: None })
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
        let mut found: Vec<(Tab, Range<usize>)> = here.iter().map(|s| (of.tab_of(s.source), s.range())).collect();
        let declared = of.analysis.definition(source, offset);
        let shared: Option<Span> = here.iter().copied().find(|s| s.source == COMMON).or(declared);
        if let Some(shared) = shared.filter(|s| s.source == COMMON) {
            let project = self.project();
            for pass in project.passes.iter().filter(|p| p.id != of.texts.pass) {
                let uses = Texts::of(project, pass).analyse().uses(COMMON, shared.start as usize);
                let there = uses.iter().filter(|s| s.source == CODE);
                found.extend(there.map(|s| (Tab::Pass(pass.id.clone()), s.range())));
            }
        }
        found
    }

    /// The tab whose text is analysed from now on.
    pub(super) fn bring_to_front(&mut self, tab: Tab) {
        if let Tab::Pass(id) = &tab {
            self.analyst.pass = id.clone();
        }
        self.analyst.front = Some(tab);
    }

    /// Hands the newest texts to the analyst if they are new to it.
    pub(super) fn analyse(&mut self) {
        let Some(front) = self.analyst.front.clone() else { return };
        let project = self.documents.current();
        let pass = project.pass(&self.analyst.pass).or_else(|| project.pass(&PassId::Image));
        let Some(pass) = pass.or(project.passes.first()) else { return };
        let texts = Texts::of(project, pass);
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
