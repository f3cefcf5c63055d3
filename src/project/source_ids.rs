//! A [`SourceId`] identifies a text of a project: Common (an empty text if there is none), then the passes in order,
//! then the stages of passes that draw meshes in order, then the files they include, then the texts of fills, then
//! those of conditions. Only this module assigns them. A [`TextLocation`] is a location in one of them, for display.

use super::{Included, PassName, Project, Stage, Tab};
use eddy_diag::{SourceId, SourceMap, Span};
use std::ops::Range;

impl Project {
    /// The id of Common's text.
    pub const COMMON_ID: SourceId = SourceId(0);

    /// Returns the id of the own text of `passes[pass]`.
    pub fn pass_id(pass: usize) -> SourceId {
        id(1 + pass)
    }

    /// Returns the id of a stage of `passes[pass]`.
    pub fn stage_id(&self, pass: usize, stage: Stage) -> SourceId {
        match stage {
            Stage::Own => Self::pass_id(pass),
            Stage::File(n) => {
                let before = self.stages().take_while(|(index, _)| *index < pass).count();
                id(self.first_stage() + before + n)
            }
        }
    }

    /// Returns the id of the text that contains the `n`-th of [`Project::fills`].
    pub(super) fn fill_id(&self, n: usize) -> SourceId {
        id(self.first_included() + self.includes.len() + n)
    }

    /// Returns the id of the text that contains the `n`-th of [`Project::conditions`].
    pub(super) fn condition_id(&self, n: usize) -> SourceId {
        self.fill_id(self.fills().count() + n)
    }

    /// Returns the included file with an id.
    pub(super) fn included(&self, source: SourceId) -> Option<&Included> {
        self.includes.get(usize::from(source.0).checked_sub(self.first_included())?)
    }

    /// Returns the tab a diagnostic's source belongs to; `None` for one this project does not have.
    pub fn tab_of(&self, source: SourceId) -> Option<Tab> {
        match usize::from(source.0) {
            0 => Some(Tab::Common),
            i if i < self.first_stage() => Some(Tab::Pass(self.passes[i - 1].id.clone())),
            i if i < self.first_included() => {
                let (pass, stage) = self.stages().nth(i - self.first_stage())?;
                Some(Tab::Stage(self.passes[pass].id.clone(), stage.name.clone()))
            }
            _ => {
                let included = self.included(source).filter(|i| i.trouble.is_none())?;
                Some(Tab::Included(included.source.name.clone()))
            }
        }
    }

    /// Returns the id of a tab's text; `None` for a tab that this project does not have.
    pub fn id_of(&self, tab: &Tab) -> Option<SourceId> {
        let place = |id: &PassName| self.passes.iter().position(|p| p.id == *id);
        match tab {
            Tab::Common => self.common.as_ref().map(|_| Self::COMMON_ID),
            Tab::Pass(of) => place(of).map(Self::pass_id),
            Tab::Stage(of, file) => {
                let pass = place(of)?;
                let at = self.stages().position(|(index, stage)| index == pass && stage.name == *file)?;
                Some(id(self.first_stage() + at))
            }
            Tab::Included(file) => {
                let at = self.includes.iter().position(|i| i.trouble.is_none() && i.source.name == *file)?;
                Some(id(self.first_included() + at))
            }
        }
    }

    pub(super) fn first_stage(&self) -> usize {
        1 + self.passes.len()
    }

    pub(super) fn first_included(&self) -> usize {
        self.first_stage() + self.stages().count()
    }
}

/// A project has far fewer texts than there are ids; see [`super::limits`].
fn id(place: usize) -> SourceId {
    SourceId(place as u16)
}

/// A location in a text of the project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextLocation {
    /// `None` if the text is not a tab.
    pub tab: Option<Tab>,
    /// The text's name.
    pub text: String,
    /// Line and column of the start, counted from 1; columns count characters.
    pub line: usize,
    pub column: usize,
    /// The byte range in the compiled text.
    pub range: Range<usize>,
}

impl TextLocation {
    /// Returns `None` for a span of a text that `sources` does not have.
    pub fn new(span: Span, sources: &SourceMap, project: &Project) -> Option<Self> {
        let at = sources.line_column(span)?;
        let text = sources.get(span.source)?.name.clone();
        let tab = project.tab_of(span.source);
        Some(Self { tab, text, line: at.line, column: at.column, range: span.range() })
    }

    /// The tab's title, or the text's own name if it is not a tab.
    pub fn title(&self) -> String {
        self.tab.as_ref().map_or_else(|| self.text.clone(), Tab::title)
    }
}
