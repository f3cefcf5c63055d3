//! The fills of a project's passes, and the texts into which their diagnostics point.

use super::{Fill, FillKind, FillValue, Pass, Project};
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

/// A text to compile, and the byte range of a fill's value in it.
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

    /// The text that contains a fill of `passes[pass]`, by its id in [`Project::sources`].
    pub fn fill_text(&self, pass: usize, kind: FillKind) -> Option<FillText> {
        let (n, (.., fill)) = self.fills().enumerate().find(|(_, (p, k, _))| (*p, *k) == (pass, kind))?;
        let (text, range) = fill.text();
        Some(FillText { id: self.fill_id(n), text, range })
    }

    /// Describes the first expression of `eddy.toml` that uses one of the author's own uniforms: an edit of
    /// a text cannot change it.
    pub fn fill_that_names(&self, uniform: &str) -> Option<String> {
        self.custom_uniforms().get(uniform)?;
        let tested = self.conditions().find(|(_, condition)| condition.names(uniform));
        if let Some((index, _)) = tested {
            return Some(format!("the condition of {}", self.passes[index].id.title()));
        }
        let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        self.fills().find_map(|(index, kind, fill)| {
            let FillValue::Expression(text) = &fill.value else { return None };
            let is_used = text.split(|c| !is_of_name(c)).any(|word| word == uniform);
            let what = match kind {
                FillKind::Initial => "initial state",
                FillKind::Boundary => "edges",
            };
            is_used.then(|| format!("the {what} of {}", self.passes[index].id.title()))
        })
    }

    /// Returns the span of a fill.
    pub fn fill_span(&self, pass: usize, kind: FillKind) -> Option<Span> {
        let FillText { id, range, .. } = self.fill_text(pass, kind)?;
        Some(Span::new(id, range))
    }
}
