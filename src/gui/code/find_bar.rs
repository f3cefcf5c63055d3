//! The bar for finding and replacing.

use crate::{
    gui::{
        actions::Action,
        editor::{CodeEditor, Finder, Query},
        icons::{self, Icon},
        outbox::Outbox,
        theme,
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
    takes_focus: bool,
    /// The tab, revision and query that `found` belongs to.
    made_for: Option<(Tab, u64, Query)>,
    found: Found,
}

/// The outcome of a query.
#[derive(Default)]
struct Found {
    /// `None` before anything is asked; else the finder, or what is wrong with the expression.
    finder: Option<Result<Finder, String>>,
    matches: Vec<Range<usize>>,
}

impl FindBar {
    /// Opens it with what is selected, if that is a part of a line.
    pub fn open(&mut self, selected: &str, replaces: bool) {
        if !selected.is_empty() && !selected.contains('\n') {
            self.query.text = selected.to_owned();
            self.query.is_regex = false;
        }
        self.replaces = replaces || (self.is_open && self.replaces);
        self.is_open = true;
        self.takes_focus = true;
    }

    pub fn close(&mut self) {
        self.is_open = false;
    }

    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// There is nothing to look for.
    pub fn is_empty(&self) -> bool {
        self.query.text.is_empty()
    }

    /// Returns the places to tint: none while the bar is closed.
    pub fn matches(&self) -> &[Range<usize>] {
        if self.is_open { &self.found.matches } else { &[] }
    }

    pub fn switch(&mut self, switch: impl Fn(&mut Query)) {
        switch(&mut self.query);
    }

    /// Looks again if the text or what is looked for is not what it was.
    fn refresh(&mut self, tab: &Tab, editor: &CodeEditor) {
        let now = (tab.clone(), editor.buffer().revision(), self.query.clone());
        if self.made_for.as_ref() == Some(&now) {
            return;
        }
        let finder = self.query.finder();
        let matches = finder.as_ref().map(|f| f.matches(editor.buffer().text())).unwrap_or_default();
        self.found = Found { finder: Some(finder), matches };
        self.made_for = Some(now);
    }

    /// Selects the next match, or the one before.
    pub fn step(&mut self, tab: &Tab, editor: &mut CodeEditor, forward: bool) {
        self.refresh(tab, editor);
        if editor.edit(|buffer| buffer.find(&self.found.matches, forward)).is_some() {
            editor.reveal();
        }
    }

    /// Replaces the selected match if it is one, and goes to the next.
    fn replace_one(&mut self, tab: &Tab, editor: &mut CodeEditor) {
        self.refresh(tab, editor);
        if let Some(Ok(finder)) = &self.found.finder {
            editor.edit(|buffer| buffer.replace_match(finder, &self.found.matches, &self.with));
        }
        self.step(tab, editor, true);
    }

    pub fn replace_all(&mut self, tab: &Tab, editor: &mut CodeEditor) {
        self.refresh(tab, editor);
        if let Some(Ok(finder)) = &self.found.finder {
            editor.edit(|buffer| buffer.replace_all(finder, &self.found.matches, &self.with));
        }
        self.refresh(tab, editor);
    }

    /// Shows it; true when it is to be closed.
    pub fn show(&mut self, ui: &mut Ui, tab: &Tab, editor: &mut CodeEditor, out: &mut Outbox) -> bool {
        self.refresh(tab, editor);
        let mut close = false;
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
                self.step(tab, editor, !ui.input(|i| i.modifiers.shift));
                field.request_focus();
            }
            let mut switch = |ui: &mut Ui, on: &mut bool, name: &str, label: &str, tip: &str, action: Action| {
                let response = ui.toggle_value(on, label).on_hover_text(out.keys.tip(tip, action));
                out.place(name, response.rect);
            };
            let (case, regex) = (&mut self.query.match_case, &mut self.query.is_regex);
            switch(ui, case, "find:case", "Aa", "Match case", Action::FindCase);
            switch(ui, regex, "find:regex", ".*", "Use regular expression; $1 in the replacement", Action::FindRegex);
            self.refresh(tab, editor);
            let at = self.found.matches.iter().position(|m| *m == editor.buffer().selection().range());
            let (text, color) = match (&self.found.finder, self.found.matches.len(), at) {
                (Some(Err(reason)), ..) => (reason.clone(), theme::of(ui).error),
                (_, 0, _) if self.query.text.is_empty() => (String::new(), theme::of(ui).weak),
                (_, 0, _) => ("none".into(), theme::of(ui).weak),
                (_, n, Some(at)) => (format!("{} of {n}", at + 1), theme::of(ui).weak),
                (_, n, None) => (n.to_string(), theme::of(ui).weak),
            };
            let count = ui.colored_label(color, text);
            out.place("find:count", count.rect);
            for (icon, label, forward, action) in [
                (Icon::Previous, "Find previous", false, Action::FindPrevious),
                (Icon::Next, "Find next", true, Action::FindNext),
            ] {
                if icons::button(ui, icon, label).on_hover_text(out.keys.tip(label, action)).clicked() {
                    self.step(tab, editor, forward);
                }
            }
            if self.replaces {
                self.replacing(ui, tab, editor, out);
            } else {
                let tip = out.keys.tip("Show replace", Action::Replace);
                if ui.button("Replace…").on_hover_text(tip).clicked() {
                    self.replaces = true;
                }
            }
            close = icons::button(ui, Icon::Close, "Close").on_hover_text("Close (Esc)").clicked();
        });
        close
    }

    fn replacing(&mut self, ui: &mut Ui, tab: &Tab, editor: &mut CodeEditor, out: &mut Outbox) {
        let field = ui.add(TextEdit::singleline(&mut self.with).hint_text("Replace with").desired_width(150.0));
        out.place("field:replace", field.rect);
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if entered {
            field.request_focus();
        }
        let some = !self.found.matches.is_empty();
        let one =
            ui.add_enabled(some, Button::new("Replace")).on_hover_text("Replace this match and find the next (Enter)");
        if out.clicked("find:replace", &one) || (entered && some) {
            self.replace_one(tab, editor);
        }
        let all = ui.add_enabled(some, Button::new("All"));
        let all = all.on_hover_text(out.keys.tip("Replace all matches", Action::ReplaceAll));
        if out.clicked("find:replace-all", &all) {
            self.replace_all(tab, editor);
        }
    }
}
