//! Caches the compiled Common: edits elsewhere do not compile it again.

use super::Sources;
use eddy_diag::{Diagnostic, SourceId, Span};
use eddy_glsl::{Include, Preamble, UniformValue};
use eddy_project::Dialect;
use std::sync::Arc;

/// Keeps the Common that [`Sources`] have compiled, for later ones with the same Common.
#[derive(Default)]
pub struct PreambleCache {
    last: Option<(Key, Option<Arc<Preamble>>)>,
}

/// All inputs of compiling Common.
#[derive(PartialEq)]
pub(super) struct Key {
    common: Arc<str>,
    includes: Vec<IncludeKey>,
    values: Vec<UniformValue>,
}

/// A line and the text that replaces it, or the diagnostic if there is none.
type IncludeKey = (Span, Result<(SourceId, Arc<str>), Diagnostic>);

impl PreambleCache {
    /// Provides these texts with the compiled Common, if it is the same.
    pub fn provide_to(&self, texts: &Sources<'_>) {
        if let Some((key, preamble)) = &self.last
            && texts.preamble_key().as_ref() == Some(key)
        {
            // If the texts have compiled it themselves, the result is equal.
            let _ = texts.preamble.set(preamble.clone());
        }
    }

    /// Stores the compiled Common of these texts, if they needed it.
    pub fn update_from(&mut self, texts: &Sources<'_>) {
        if let (Some(key), Some(preamble)) = (texts.preamble_key(), texts.preamble.get()) {
            self.last = Some((key, preamble.clone()));
        }
    }
}

impl Sources<'_> {
    fn preamble_key(&self) -> Option<Key> {
        let common = self.common()?;
        let includes = self.includes([common.id]);
        Some(Key {
            common: self.shared(common),
            includes: includes.iter().map(|i| self.include_key(i)).collect(),
            values: self.values.clone(),
        })
    }

    fn include_key(&self, include: &Include<'_>) -> IncludeKey {
        (include.line, include.text.map(|text| (text.id, self.shared(text))).map_err(Clone::clone))
    }

    /// The compiled Common, created when first needed. `None` if there is none, or if each pass must compile it.
    pub(super) fn preamble(&self) -> Option<&Preamble> {
        let read = || {
            if self.project.dialect != Dialect::Shadertoy {
                return None;
            }
            let common = self.common()?;
            Preamble::new(common, &self.includes([common.id]), &self.values).map(Arc::new)
        };
        self.preamble.get_or_init(read).as_deref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_diag as diag;
    use eddy_glsl::Driver;
    use eddy_project as project;

    /// Compiles a preset after an edit of its texts, and returns whether Common was compiled again.
    fn reads(kept: &mut PreambleCache, edit: impl FnOnce(&mut project::Project)) -> bool {
        let mut project = project::presets::load("fluid").expect("a preset").project;
        edit(&mut project);
        let texts = Sources::new(&project);
        kept.provide_to(&texts);
        let is_lent = texts.preamble.get().is_some();
        texts.compile_pass(0, Driver::default()).map(drop).expect("a program without errors");
        kept.update_from(&texts);
        !is_lent
    }

    fn add_line(source: &mut project::Source) {
        source.text = format!("{}\n// A further line.\n", source.text).into();
    }

    #[test]
    fn editing_a_pass_does_not_recompile_common() {
        let mut kept = PreambleCache::default();
        assert!(reads(&mut kept, |_| {}), "nothing was read yet");
        assert!(!reads(&mut kept, |_| {}));
        assert!(!reads(&mut kept, |project| add_line(&mut project.passes[0].source)));
        assert!(reads(&mut kept, |project| add_line(project.common.as_mut().expect("it has one"))));
        assert!(reads(&mut kept, |_| {}), "the newest is kept");
    }

    #[test]
    fn errors_in_common_are_reported_once() {
        for wrong in ["float wrong(float x) { return y; }", "float wrong(float x) { return x }"] {
            let mut project = project::presets::load("fluid").expect("a preset").project;
            let common = project.common.as_mut().expect("it has one");
            common.text = format!("{}\n{wrong}\n", common.text).into();
            let outcomes = Sources::new(&project).compile_all(Driver::default());
            let errors: Vec<_> = outcomes.into_iter().filter_map(Result::err).collect();
            assert!(errors.len() >= project.passes.len(), "each pass has the mistake");
            let mut all = Vec::new();
            errors.into_iter().for_each(|errors| diag::append(&mut all, errors));
            let places: Vec<_> = all.iter().map(|d| d.span.map(|span| span.source)).collect();
            assert_eq!(places, [Some(project::Project::COMMON_ID)], "{all:?}");
        }
    }
}
