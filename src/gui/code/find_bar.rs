//! The bar for finding and replacing.

use crate::{
    gui::{
        actions::Action,
        editor::{CodeEditor, Finder, Query},
        icons::{self, Icon},
        theme,
        ui_output::UiOutput,
    },
    project::Tab,
};
use egui::{Button, Key, TextEdit, Ui};
use std::ops::Range;

#[derive(Default)]
pub(super) struct FindBar {
    is_open: bool,
    replaces: bool,
    query: Query,
    with: String,
    /// Searches every text of the project.
    everywhere: bool,
    /// Searches only a part of a text.
    scope: Option<Scope>,
    takes_focus: bool,
    /// The tab, revision and query to which `found` belongs.
    made_for: Option<(Tab, u64, Query, Option<Range<usize>>)>,
    found: Found,
}

/// The results of a frame of the bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FindBarAction {
    Nothing,
    Close,
    /// Go to the next match, or to the previous one.
    Step(bool),
    Replace,
    ReplaceAll,
}

/// The lines that were selected when the search was limited to them.
struct Scope {
    tab: Tab,
    range: Range<usize>,
    /// The revision and the length of the text to which the range belongs.
    of: (u64, usize),
}

/// The result of a query.
#[derive(Default)]
struct Found {
    /// `None` without a query; otherwise the finder, or the error in the expression.
    finder: Option<Result<Finder, String>>,
    matches: Vec<Range<usize>>,
}

impl FindBar {
    /// Opens the bar with the selected text, if that is a part of a line.
    pub(super) fn open(&mut self, selected: &str, replaces: bool) {
        if !selected.is_empty() && !selected.contains('\n') {
            self.query.text = selected.to_owned();
            self.query.is_regex = false;
        }
        self.replaces = replaces || (self.is_open && self.replaces);
        self.is_open = true;
        self.takes_focus = true;
    }

    pub(super) fn close(&mut self) {
        self.is_open = false;
        self.scope = None;
    }

    /// Limits the search to the selection, or removes the limit.
    pub(super) fn toggle_scope(&mut self, tab: &Tab, editor: &CodeEditor) {
        let buffer = editor.buffer();
        let range = buffer.selection().range();
        let scope = || Scope { tab: tab.clone(), range, of: (buffer.revision(), buffer.text().len()) };
        self.scope = match self.scope.take() {
            None if !buffer.selection().is_empty() => Some(scope()),
            _ => None,
        };
    }

    /// Returns the limits of the search in a text, which move with what is edited inside or before them.
    fn scope(&mut self, tab: &Tab, editor: &CodeEditor) -> Option<Range<usize>> {
        let scope = self.scope.as_mut().filter(|scope| scope.tab == *tab)?;
        let buffer = editor.buffer();
        let now = (buffer.revision(), buffer.text().len());
        if scope.of.0 != now.0 {
            let by = now.1 as isize - scope.of.1 as isize;
            let is_before = buffer.selection().range().end < scope.range.start.saturating_add_signed(by.min(0));
            let start = if is_before { scope.range.start.saturating_add_signed(by) } else { scope.range.start };
            let end = scope.range.end.saturating_add_signed(by).clamp(start, now.1);
            (scope.range, scope.of) = (start..end, now);
        }
        Some(scope.range.clone())
    }

    pub(super) fn is_open(&self) -> bool {
        self.is_open
    }

    pub(super) fn is_everywhere(&self) -> bool {
        self.everywhere
    }

    pub(super) fn set_everywhere(&mut self, on: bool) {
        self.everywhere = on;
    }

    pub(super) fn query(&self) -> &Query {
        &self.query
    }

    /// Returns the replacement.
    pub(super) fn with(&self) -> &str {
        &self.with
    }

    /// Returns whether the query is empty.
    pub(super) fn is_empty(&self) -> bool {
        self.query.text.is_empty()
    }

    /// Returns the matches to tint: none while the bar is closed.
    pub(super) fn matches(&self) -> &[Range<usize>] {
        if self.is_open { &self.found.matches } else { &[] }
    }

    pub(super) fn switch(&mut self, switch: impl Fn(&mut Query)) {
        switch(&mut self.query);
    }

    /// Searches again if the text or the query has changed.
    fn refresh(&mut self, tab: &Tab, editor: &CodeEditor) {
        let scope = self.scope(tab, editor);
        let now = (tab.clone(), editor.buffer().revision(), self.query.clone(), scope.clone());
        if self.made_for.as_ref() == Some(&now) {
            return;
        }
        let finder = self.query.finder();
        let mut matches = finder.as_ref().map(|f| f.matches(editor.buffer().text())).unwrap_or_default();
        if let Some(scope) = scope {
            matches.retain(|found| scope.start <= found.start && found.end <= scope.end);
        }
        self.found = Found { finder: Some(finder), matches };
        self.made_for = Some(now);
    }

    /// Selects the next match, or the previous one.
    pub(super) fn step(&mut self, tab: &Tab, editor: &mut CodeEditor, forward: bool) {
        self.refresh(tab, editor);
        if editor.edit(|buffer| buffer.find(&self.found.matches, forward)).is_some() {
            editor.reveal();
        }
    }

    /// Replaces the selection if it is a match.
    pub(super) fn replace_one(&mut self, tab: &Tab, editor: &mut CodeEditor) {
        self.refresh(tab, editor);
        if let Some(Ok(finder)) = &self.found.finder {
            editor.edit(|buffer| buffer.replace_match(finder, &self.found.matches, &self.with));
        }
    }

    pub(super) fn replace_all(&mut self, tab: &Tab, editor: &mut CodeEditor) {
        self.refresh(tab, editor);
        if let Some(Ok(finder)) = &self.found.finder {
            editor.edit(|buffer| buffer.replace_all(finder, &self.found.matches, &self.with));
        }
        self.refresh(tab, editor);
    }

    /// Shows the bar. `everywhere`: the matches in all texts.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        tab: &Tab,
        editor: &CodeEditor,
        everywhere: usize,
        out: &mut UiOutput,
    ) -> FindBarAction {
        self.refresh(tab, editor);
        let mut asked = FindBarAction::Nothing;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.y = 4.0;
            let wrong = matches!(self.found.finder, Some(Err(_)));
            let mut field = TextEdit::singleline(&mut self.query.text).hint_text("Find").desired_width(150.0);
            if wrong {
                field = field.text_color(theme::of(ui).error);
            }
            let field = ui.add(field);
            out.place("field:find", field.rect);
            if std::mem::take(&mut self.takes_focus) {
                field.request_focus();
            }
            if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
                asked = FindBarAction::Step(!ui.input(|i| i.modifiers.shift));
                field.request_focus();
            }
            let mut switch = |ui: &mut Ui, on: &mut bool, name: &str, label: &str, tip: &str, action: Action| {
                let response = ui.toggle_value(on, label).on_hover_text(out.keys.tip(tip, action));
                out.place(name, response.rect);
            };
            let Query { match_case: case, is_regex: regex, whole_word: word, .. } = &mut self.query;
            let (all, tip) = (&mut self.everywhere, "Find in every text of the project");
            switch(ui, all, "find:everywhere", "All passes", tip, Action::FindEverywhere);
            switch(ui, case, "find:case", "Aa", "Match case", Action::FindCase);
            switch(ui, word, "find:word", "\u{201c}ab\u{201d}", "Match whole word", Action::FindWord);
            switch(ui, regex, "find:regex", ".*", "Use regular expression; $1 in the replacement", Action::FindRegex);
            let (mut is_limited, before) = (self.scope.is_some(), self.scope.is_some());
            switch(ui, &mut is_limited, "find:selection", "In selection", "Find in selection", Action::FindInSelection);
            if is_limited != before {
                self.toggle_scope(tab, editor);
            }
            self.refresh(tab, editor);
            let at = self.found.matches.iter().position(|m| *m == editor.buffer().selection().range());
            let count = if self.everywhere { everywhere } else { self.found.matches.len() };
            let at = at.filter(|_| !self.everywhere);
            let (text, color) = match (&self.found.finder, count, at) {
                (Some(Err(reason)), ..) => (reason.clone(), theme::of(ui).error),
                (_, 0, _) if self.query.text.is_empty() => (String::new(), theme::of(ui).weak),
                (_, 0, _) => ("No matches".into(), theme::of(ui).weak),
                (_, n, Some(at)) => (format!("{} of {n}", at + 1), theme::of(ui).weak),
                (_, n, None) => (n.to_string(), theme::of(ui).weak),
            };
            // An empty text has no place in a wrapping row.
            if !text.is_empty() {
                let label = ui.colored_label(color, text);
                out.place("find:count", label.rect);
            }
            for (icon, label, forward, action) in [
                (Icon::Previous, "Find previous", false, Action::FindPrevious),
                (Icon::Next, "Find next", true, Action::FindNext),
            ] {
                let step = icons::button(ui, icon, label).on_hover_text(out.keys.tip(label, action));
                if out.clicked(if forward { "find:next" } else { "find:previous" }, &step) {
                    asked = FindBarAction::Step(forward);
                }
            }
            if self.replaces {
                self.replacing(ui, count, &mut asked, out);
            } else {
                let tip = out.keys.tip("Show replace", Action::Replace);
                if ui.button("Replace…").on_hover_text(tip).clicked() {
                    self.replaces = true;
                }
            }
            if icons::button(ui, Icon::Close, "Close").on_hover_text("Close (Esc)").clicked() {
                asked = FindBarAction::Close;
            }
        });
        asked
    }

    fn replacing(&mut self, ui: &mut Ui, count: usize, asked: &mut FindBarAction, out: &mut UiOutput) {
        let field = ui.add(TextEdit::singleline(&mut self.with).hint_text("Replace with").desired_width(150.0));
        out.place("field:replace", field.rect);
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if entered {
            field.request_focus();
        }
        let some = count > 0;
        let one =
            ui.add_enabled(some, Button::new("Replace")).on_hover_text("Replace this match and find the next (Enter)");
        if out.clicked("find:replace", &one) || (entered && some) {
            *asked = FindBarAction::Replace;
        }
        let all = ui.add_enabled(some, Button::new("All"));
        let all = all.on_hover_text(out.keys.tip("Replace all matches", Action::ReplaceAll));
        if out.clicked("find:replace-all", &all) {
            *asked = FindBarAction::ReplaceAll;
        }
    }
}
