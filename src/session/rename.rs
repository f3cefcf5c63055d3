//! Renaming of a symbol of the author's everywhere in the project.

use super::{
    open_project::OpenProject,
    view::{TabEdit, TabFix},
};
use eddy_diag::{Fix, SourceId, SourceMap, Span};
use eddy_engine as engine;
use eddy_glsl::services::{Analysis, Places, Programs};
use eddy_project::{Project, Tab};

impl OpenProject {
    /// Returns the symbol at a byte of a tab that can be renamed, or why it cannot.
    pub(crate) fn renamable(&self, tab: &Tab, at: usize) -> Result<String, String> {
        let project = self.project();
        let source = project.id_of(tab).ok_or_else(|| "there is no name here".to_owned())?;
        Read::new(project).programs(|programs| programs.renamable(source, at).map(|(name, _)| name))
    }

    /// Returns the edits that rename the symbol at a byte of a tab. Fails if the symbol is not the author's, and if the
    /// new name would change the meaning of something.
    pub(crate) fn rename(&self, tab: &Tab, at: usize, to: &str) -> Result<TabFix, String> {
        let project = self.project();
        let source = project.id_of(tab).ok_or_else(|| "there is no name here".to_owned())?;
        let fix = Read::new(project).programs(|programs| {
            let (name, _) = programs.renamable(source, at)?;
            if let Some(place) = project.fill_that_names(&name) {
                let to = to.trim();
                return Err(format!("`{name}` is used in {place} too: write `{to}` there first, then rename it"));
            }
            programs.rename((source, at), to, |fix, check| {
                let renamed = project.with_edits(fix);
                Read::new(&renamed).programs(|programs| check(programs));
            })
        })?;
        let edit = |edit: &eddy_diag::Edit| {
            let tab = project.tab_of(edit.span.source)?;
            let replaced = self.text(&tab).get(edit.span.range())?.to_owned();
            Some(TabEdit { tab, range: edit.span.range(), replaced, text: edit.text.clone() })
        };
        let Fix { title, edits } = &fix;
        let edits = edits.iter().map(edit).collect::<Option<Vec<_>>>();
        let edits = edits.ok_or_else(|| "the name is used somewhere that cannot be edited here".to_owned())?;
        Ok(TabFix { title: title.clone(), edits })
    }
}

/// Every place that names the symbol at a byte of a text, in all passes; none for a symbol that no text declares.
pub(super) fn everywhere(project: &Project, source: SourceId, at: usize) -> Places {
    Read::new(project).programs(|programs| programs.places(source, at))
}

/// Every stage of every pass, analysed.
struct Read {
    analyses: Vec<Analysis>,
    uniforms: Vec<(String, Span)>,
    texts: SourceMap,
}

impl Read {
    fn new(project: &Project) -> Self {
        let texts = engine::Sources::new(project);
        let mut analyses = Vec::new();
        for (index, pass) in project.passes.iter().enumerate() {
            analyses.extend(pass.body.texts().map(|stage| texts.analyse_stage(index, stage)));
        }
        Self { analyses, uniforms: project.custom_uniform_names(), texts: project.texts() }
    }

    fn programs<T>(&self, work: impl FnOnce(&Programs<'_>) -> T) -> T {
        let analyses: Vec<&Analysis> = self.analyses.iter().collect();
        work(&Programs { analyses: &analyses, uniforms: &self.uniforms, texts: &self.texts })
    }
}
