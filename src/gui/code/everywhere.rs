//! Finding and replacing in every text of the project.

use super::CodePanel;
use crate::{
    gui::{editor::Query, ui_output::UiOutput, uses::Uses},
    project::Tab,
    session::Level,
};
use std::ops::Range;

impl CodePanel {
    /// Opens the bar for finding in all texts, or toggles it back to the one in front.
    pub(crate) fn open_find_everywhere(&mut self) {
        let is_on = self.find.is_open() && self.find.is_everywhere();
        self.open_find(false);
        self.find.set_everywhere(!is_on);
    }

    /// Searches again if the query or a text has changed, and lists the matches.
    pub(super) fn look_everywhere(&mut self) {
        if !self.find.is_open() || !self.find.is_everywhere() {
            if std::mem::take(&mut self.everywhere.is_listed) {
                self.uses = None;
            }
            self.everywhere.of = None;
            self.everywhere.places.clear();
            return;
        }
        let tabs = &self.order;
        let revision = |tab: &Tab| Some((tab.clone(), self.editors.get(tab)?.buffer().revision()));
        let now = (self.find.query().clone(), tabs.iter().filter_map(revision).collect::<Vec<_>>());
        if self.everywhere.of.as_ref() == Some(&now) {
            return;
        }
        let finder = now.0.finder().ok();
        let mut places = Vec::new();
        for tab in tabs {
            let (Some(finder), Some(editor)) = (&finder, self.editors.get(tab)) else { continue };
            places.extend(finder.matches(editor.buffer().text()).into_iter().map(|m| (tab.clone(), m)));
        }
        // The session gets an edited text only after this frame.
        let text = |tab: &Tab| self.editors.get(tab).map(|editor| editor.buffer().text());
        self.uses = Uses::found(text, &now.0.text, places.clone());
        self.everywhere = ProjectMatches { of: Some(now), places, is_listed: true };
    }

    /// Selects the next or the previous match in any text. The keyboard focus does not move.
    pub(super) fn step_everywhere(&mut self, forward: bool) {
        let rank = |tab: &Tab| self.order.iter().position(|other| other == tab).unwrap_or(usize::MAX);
        let Some(buffer) = self.buffer() else { return };
        let selected = buffer.selection().range();
        let here = (rank(&self.current), selected.start);
        let places = &self.everywhere.places;
        let key = |place: &(Tab, Range<usize>)| (rank(&place.0), place.1.start);
        let is_here = |place: &&(Tab, Range<usize>)| key(place) == here && place.1 == selected;
        let found = if forward {
            places.iter().find(|p| key(p) >= here && !is_here(p)).or(places.first())
        } else {
            places.iter().rev().find(|p| key(p) < here).or(places.last())
        };
        let Some((tab, range)) = found.cloned() else { return };
        if let Some(editor) = self.editors.get_mut(&tab) {
            editor.edit(|buffer| buffer.select(range.start, range.end));
            editor.reveal();
        }
        self.bring(tab);
    }

    /// Replaces every match in every text, as one step of undo.
    pub(super) fn replace_everywhere(&mut self, out: &mut UiOutput) {
        let Ok(finder) = self.find.query().finder() else { return };
        let (mut count, mut changed) = (0, Vec::new());
        for tab in &self.order {
            let Some(editor) = self.editors.get_mut(tab) else { continue };
            let matches = finder.matches(editor.buffer().text());
            if !matches.is_empty() {
                count += matches.len();
                changed.push(tab.clone());
                editor.edit(|buffer| buffer.replace_all(&finder, &matches, self.find.with()));
            }
        }
        self.join_steps(&changed);
        self.report_changed(out);
        if count > 0 {
            let matches = if count == 1 { "match" } else { "matches" };
            let tabs = if changed.len() == 1 { "tab" } else { "tabs" };
            out.notify(Level::Info, format!("Replaced {count} {matches} in {} {tabs}", changed.len()));
        }
    }
}

/// The matches of a query in all texts.
#[derive(Default)]
pub(super) struct ProjectMatches {
    /// The query and the revisions of the texts to which the matches belong.
    pub of: Option<(Query, Vec<(Tab, u64)>)>,
    pub places: Vec<(Tab, Range<usize>)>,
    /// The matches are listed below the code.
    pub is_listed: bool,
}

impl ProjectMatches {
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }
}
