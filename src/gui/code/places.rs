//! Places in a text: parses those that people type, and converts those of diagnostics.

use crate::{
    gui::editor::Mark,
    project::Tab,
    session::{Session, TabDiagnostic},
};

/// Parses `12` or `12:5`, counted from 1, to a place counted from 0.
pub(super) fn parse(text: &str) -> Option<(usize, usize)> {
    let (line, column) = text.trim().split_once(':').unwrap_or((text.trim(), "1"));
    let from_0 = |s: &str| Some(s.trim().parse::<usize>().ok()?.saturating_sub(1));
    Some((from_0(line)?, from_0(column)?))
}

/// Returns the diagnostics of a tab as marks of the editor.
pub(super) fn marks(session: &Session, tab: &Tab) -> Vec<Mark> {
    let here = |d: &TabDiagnostic| d.place.clone().filter(|place| place.tab.as_ref() == Some(tab));
    let mark = |d: &TabDiagnostic| {
        let place = here(d)?;
        let labels = d.labels.iter().map(|l| format!("{}:{}: {}", l.place.text, l.place.line, l.message));
        Some(Mark {
            line: place.line - 1,
            range: place.range,
            severity: d.severity,
            message: d.message.clone(),
            hints: labels.chain(d.hints.iter().cloned()).collect(),
            has_fix: !d.fixes.is_empty(),
        })
    };
    session.diagnostics().iter().filter_map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_numbers_are_parsed() {
        assert_eq!(parse(" 12 "), Some((11, 0)));
        assert_eq!(parse("12:5"), Some((11, 4)));
        assert_eq!(parse("0"), Some((0, 0)));
        assert_eq!(parse("x"), None);
        assert_eq!(parse(""), None);
    }
}
