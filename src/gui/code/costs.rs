//! The costs of the lines of a text, for its editor.

use crate::{
    gui::editor::LineCost,
    project::Tab,
    session::{CountedPass, Session},
};
use std::collections::BTreeMap;

/// Returns the costs of the lines of a tab, in order; none if they are not shown, or of another text.
pub(super) fn of_lines(session: &Session, tab: &Tab, text: &str) -> Vec<LineCost> {
    let Some(counted) = session.counts().counted else { return Vec::new() };
    let CountedPass { project, lines, loops, .. } = &**counted;
    let sources = project.sources();
    let is_here = |source| {
        let of_tab = project.tab_of(source).as_ref() == Some(tab);
        of_tab && sources.get(source).is_some_and(|source| *source.text == *text)
    };
    let mut costs = BTreeMap::new();
    for line in lines.iter().filter(|line| is_here(line.line.source)) {
        let number = line.line.number.saturating_sub(1) as usize;
        let cost = LineCost { line: number, share: line.share as f32, is_reached: line.runs > 0, iterations: None };
        costs.insert(number, cost);
    }
    for repeated in loops.iter().filter(|repeated| is_here(repeated.line.source)) {
        let Some(cost) = costs.get_mut(&(repeated.line.number.saturating_sub(1) as usize)) else { continue };
        if repeated.runs.entries > 0 {
            let words = format!("{:.1} iterations, at most {:.0}", repeated.runs.mean(), repeated.runs.most);
            cost.iterations = Some(cost.iterations.take().map_or(words.clone(), |before| format!("{before}; {words}")));
        }
    }
    costs.into_values().collect()
}
