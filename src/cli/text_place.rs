//! A position in a text on the command line: TAB:LINE:COLUMN.

use crate::{
    diag::SourceId,
    project::{Pass, PassName, Project, Tab},
};

/// A position in a text: a tab, a line and a column, both from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct TextPlace {
    pub tab: Tab,
    pub line: usize,
    pub column: usize,
}

impl TextPlace {
    /// Parses TAB:LINE:COLUMN.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text} is not a position: write tab, line and column, as in image:12:9");
        let mut parts = text.rsplitn(3, ':');
        let mut number = || parts.next().and_then(|part| part.parse::<usize>().ok()).filter(|&n| n > 0);
        let (column, line) = (number().ok_or_else(wrong)?, number().ok_or_else(wrong)?);
        let tab = parts.next().ok_or_else(wrong)?;
        let tab = if tab == "common" { Tab::Common } else { Tab::Pass(PassName::parse(tab).ok_or_else(wrong)?) };
        Ok(Self { tab, line, column })
    }

    /// Returns the id of the tab's text and the byte offset, or an error message for an invalid position.
    pub(super) fn find(&self, project: &Project) -> Result<(SourceId, u32), String> {
        let missing = || format!("there is no tab {}", self.tab.title());
        let source = match &self.tab {
            Tab::Common => Project::COMMON_ID,
            tab => {
                let is_it = |pass: &Pass| Tab::Pass(pass.id.clone()) == *tab;
                Project::pass_id(project.passes.iter().position(is_it).ok_or_else(missing)?)
            }
        };
        let sources = project.sources();
        let text = &sources.get(source).ok_or_else(missing)?.text;
        let mut start = 0;
        for (number, line) in (1..).zip(text.split_inclusive('\n')) {
            if number == self.line {
                let column = line.char_indices().nth(self.column - 1).map_or(line.trim_end().len(), |(at, _)| at);
                return Ok((source, (start + column) as u32));
            }
            start += line.len();
        }
        Err(format!("{} has no line {}", self.tab.title(), self.line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_is_a_tab_a_line_and_a_column() {
        let place = TextPlace::parse("image:12:9").unwrap();
        assert_eq!(place, TextPlace { tab: Tab::image(), line: 12, column: 9 });
        assert_eq!(TextPlace::parse("common:1:2").unwrap().tab, Tab::Common);
        for wrong in ["image", "image:12", "image:0:1", "image:x:1", ":1:1"] {
            let why = TextPlace::parse(wrong).unwrap_err();
            assert!(why.contains("image:12:9"), "{why}");
        }
    }
}
