//! The fills of a project's passes, and the texts that diagnostics about them point into.

use super::{Fill, FillKind, Pass, Project};
use eddy_diag::{SourceId, Span};
use std::{ops::Range, sync::Arc};

impl Pass {
    pub fn fill(&self, kind: FillKind) -> Option<&Fill> {
        match kind {
            FillKind::Initial => self.settings.initial.as_ref(),
            FillKind::Boundary => self.settings.boundary.as_ref().map(|b| &b.value),
        }
    }

    pub fn fill_mut(&mut self, kind: FillKind) -> Option<&mut Fill> {
        match kind {
            FillKind::Initial => self.settings.initial.as_mut(),
            FillKind::Boundary => self.settings.boundary.as_mut().map(|b| &mut b.value),
        }
    }
}

/// A text to compile, and which of its bytes are a fill's value.
pub struct FillText {
    pub id: SourceId,
    pub text: Arc<str>,
    pub range: Range<usize>,
}

impl Project {
    /// Every fill with the index of its pass, in the order of [`Project::sources`].
    pub fn fills(&self) -> impl Iterator<Item = (usize, FillKind, &Fill)> {
        self.passes.iter().enumerate().flat_map(|(index, pass)| {
            FillKind::ALL.into_iter().filter_map(move |kind| Some((index, kind, pass.fill(kind)?)))
        })
    }

    /// The text a fill of `passes[pass]` is written in, by its id in [`Project::sources`].
    pub fn fill_text(&self, pass: usize, kind: FillKind) -> Option<FillText> {
        let (n, (.., fill)) = self.fills().enumerate().find(|(_, (p, k, _))| (*p, *k) == (pass, kind))?;
        let (text, range) = fill.text();
        Some(FillText { id: self.fill_id(n), text, range })
    }

    /// Returns where a fill is written.
    pub fn fill_span(&self, pass: usize, kind: FillKind) -> Option<Span> {
        let FillText { id, range, .. } = self.fill_text(pass, kind)?;
        Some(Span::new(id, range))
    }
}
