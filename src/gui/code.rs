//! The editor's side of the window: which tab is in front, its text, finding in it, the list of problems below.

use super::{
    editor::{Ask, CodeEditor, Help, Look, Mark, Query},
    icons::{self, Icon},
    outbox::Outbox,
    problems, tabs, theme,
    uses::Uses,
};
use crate::{
    project::{Origin, PassId, Tab},
    session::{Command, Session, TabDiagnostic},
};
use egui::{Button, Frame, Id, Key, Margin, Panel, TextEdit, Ui};
use std::{collections::HashMap, ops::Range};

const FONT_SIZES: std::ops::RangeInclusive<f32> = 8.0..=32.0;
const FONT_SIZE: f32 = 13.0;

pub struct CodePanel {
    editors: HashMap<Tab, CodeEditor>,
    current: Tab,
    /// The session's text generation that the editors hold.
    generation: Option<u64>,
    /// Which project they are of: another one's undo must not lead back here.
    project: (String, Origin),
    font_size: f32,
    find: Option<Find>,
    go_to_line: Option<String>,
    bar_takes_focus: bool,
    /// Which problem was jumped to last.
    problem: Option<usize>,
    uses: Option<Uses>,
    /// The tab the session was told is in front.
    told_front: Option<Tab>,
}

#[derive(Default)]
struct Find {
    query: Query,
    with: String,
    /// The tab, revision and query that `matches` belongs to.
    made_for: Option<(Tab, u64, Query)>,
    matches: Vec<Range<usize>>,
}

impl CodePanel {
    pub fn new() -> Self {
        Self {
            editors: HashMap::new(),
            current: Tab::Pass(PassId::Image),
            generation: None,
            project: (String::new(), Origin::Unsaved),
            font_size: FONT_SIZE,
            find: None,
            go_to_line: None,
            bar_takes_focus: false,
            problem: None,
            uses: None,
            told_front: None,
        }
    }

    pub fn current(&self) -> &Tab {
        &self.current
    }

    /// The tab in front, and the line of its caret from 0.
    #[cfg(test)]
    pub fn caret(&self) -> (Tab, usize) {
        let buffer = &self.editors[&self.current].buffer;
        let before = &buffer.text()[..buffer.selection().range().start];
        (self.current.clone(), before.matches('\n').count())
    }

    /// The text has the keyboard.
    pub fn has_keys(&self, ctx: &egui::Context) -> bool {
        ctx.memory(|m| m.has_focus(Self::id(&self.current)))
    }

    pub fn id(tab: &Tab) -> Id {
        Id::unique(("code", tab.title()))
    }

    /// Brings a tab to the front, and its caret to a line and column from 0.
    pub fn go_to(&mut self, tab: Tab, place: Option<(usize, usize)>) {
        if let Some((line, column)) = place
            && let Some(editor) = self.editors.get_mut(&tab)
        {
            editor.go_to(line, column);
        }
        self.current = tab;
    }

    pub fn go_aside(&mut self, session: &Session, by: isize) {
        let tabs = session.tabs();
        if let Some(at) = tabs.iter().position(|t| *t == self.current) {
            let to = (at as isize + by).rem_euclid(tabs.len() as isize) as usize;
            self.current = tabs[to].clone();
            self.focus();
        }
    }

    pub fn go_to_next_problem(&mut self, session: &Session) {
        let list = session.diagnostics();
        let next = self.problem.map_or(0, |i| i + 1);
        let order = (next..list.len()).chain(0..next.min(list.len()));
        let found = order.into_iter().find_map(|i| {
            let place = list[i].place.as_ref()?;
            Some((i, place.tab.clone()?, (place.line - 1, place.column - 1)))
        });
        if let Some((i, tab, place)) = found {
            self.problem = Some(i);
            self.go_to(tab, Some(place));
        }
    }

    pub fn focus(&mut self) {
        if let Some(editor) = self.editors.get_mut(&self.current) {
            editor.focus();
        }
    }

    pub fn scale_font(&mut self, by: Option<f32>) {
        self.font_size = by.map_or(FONT_SIZE, |by| self.font_size + by).clamp(*FONT_SIZES.start(), *FONT_SIZES.end());
    }

    pub fn open_find(&mut self) {
        let selected = self.editors.get(&self.current).map(|e| e.buffer.selected_text()).unwrap_or_default();
        let find = self.find.get_or_insert_default();
        if !selected.is_empty() && !selected.contains('\n') {
            find.query.text = selected.to_owned();
        }
        self.go_to_line = None;
        self.bar_takes_focus = true;
    }

    pub fn open_go_to_line(&mut self) {
        self.go_to_line = Some(String::new());
        self.find = None;
        self.bar_takes_focus = true;
    }

    /// Takes over texts that were changed by something else than the editors.
    pub fn prepare(&mut self, session: &Session) {
        let project = session.project();
        if self.project.0 != project.name || !same_place(&self.project.1, &project.origin) {
            let moved = self.project.1 == Origin::Unsaved || self.project.0 != project.name;
            // Saving under a new name keeps the texts, and so their undo.
            let kept = moved && self.editors.iter().all(|(tab, e)| session.text(tab) == e.buffer.text());
            if !kept {
                self.editors.clear();
                self.problem = None;
                self.uses = None;
                self.current = Tab::Pass(PassId::Image);
            }
            self.project = (project.name.clone(), project.origin.clone());
        }
        let tabs = session.tabs();
        if self.generation != Some(session.text_generation()) || tabs.len() != self.editors.len() {
            self.generation = Some(session.text_generation());
            self.editors.retain(|tab, _| tabs.contains(tab));
            for tab in &tabs {
                let text = session.text(tab);
                match self.editors.get_mut(tab) {
                    Some(editor) => editor.buffer.set_text(text),
                    None => drop(self.editors.insert(tab.clone(), CodeEditor::new(text))),
                }
            }
        }
        if !self.editors.contains_key(&self.current) {
            self.current = Tab::Pass(PassId::Image);
        }
    }

    /// Fills the space there is.
    pub fn show(&mut self, ui: &mut Ui, session: &Session, out: &mut Outbox) {
        ui.spacing_mut().item_spacing.y = 0.0;
        tabs::show(ui, session, &self.current, out);
        let bar = Frame::NONE.fill(theme::RAISED).inner_margin(Margin::symmetric(8, 5));
        if self.find.is_some() {
            bar.show(ui, |ui| {
                ui.set_width(ui.available_width());
                self.find_bar(ui, out);
            });
        } else if self.go_to_line.is_some() {
            bar.show(ui, |ui| {
                ui.set_width(ui.available_width());
                self.go_to_bar(ui);
            });
        }
        let room = ui.available_height();
        Panel::bottom("problems")
            .frame(Frame::NONE.fill(theme::PANEL))
            .show_separator_line(false)
            .resizable(false)
            .show(ui, |ui| problems::show(ui, session, (room * 0.35).min(150.0), out));
        self.show_uses(ui, session, out);
        if self.told_front.as_ref() != Some(&self.current) {
            self.told_front = Some(self.current.clone());
            out.ask(Command::BringToFront(self.current.clone()));
        }
        self.editor(ui, session, out);
    }

    fn editor(&mut self, ui: &mut Ui, session: &Session, out: &mut Outbox) {
        let marks = marks(session, &self.current);
        let matches = self.find.as_ref().map(|f| f.matches.as_slice()).unwrap_or_default();
        let shared = if self.current == Tab::Common { "" } else { session.text(&Tab::Common) };
        let Some(editor) = self.editors.get_mut(&self.current) else { return };
        let analysis = session.analysis().filter(|a| a.front == self.current);
        let help = analysis.and_then(|a| {
            let source = a.source_of(&self.current)?;
            Some(Help { analysis: &a.analysis, source, classes: &a.classes, text: a.text() })
        });
        let look = Look { font_size: self.font_size, marks: &marks, matches, shared, help };
        let shown = editor.show(ui, Self::id(&self.current), look);
        out.place("editor", shown.text_rect);
        for (line, rect) in shown.marked {
            out.place(format!("mark:{}", line + 1), rect);
        }
        if shown.changed {
            out.ask(Command::EditText { tab: self.current.clone(), text: editor.buffer.text().to_owned() });
            self.problem = None;
            // Its places are of the old text.
            self.uses = None;
        }
        for (name, rect) in shown.placed {
            out.place(name, rect);
        }
        for ask in shown.asks {
            let (Some(analysis), Some(help)) = (analysis, help) else { break };
            match ask {
                Ask::GoTo(span) => {
                    if let Some(tab) = analysis.tab_of(span.source) {
                        self.show_range(tab, span.range());
                    }
                }
                Ask::ListUses(at) => self.uses = Uses::new(session, session.uses(analysis, help.source, at)),
            }
            ui.ctx().request_repaint();
        }
    }

    /// Selects bytes of a tab's text.
    fn show_range(&mut self, tab: Tab, range: Range<usize>) {
        if let Some(editor) = self.editors.get_mut(&tab) {
            editor.show_range(range);
            self.current = tab;
        }
    }

    fn show_uses(&mut self, ui: &mut Ui, session: &Session, out: &mut Outbox) {
        let Some(uses) = &mut self.uses else { return };
        let frame = Frame::NONE.fill(theme::PANEL);
        let limit = (ui.available_height() * 0.35).min(160.0);
        let shown = Panel::bottom("uses")
            .frame(frame)
            .show_separator_line(false)
            .resizable(false)
            .show(ui, |ui| uses.show(ui, session, limit, out));
        let shown = shown.inner;
        if let Some((tab, range)) = shown.go_to {
            self.show_range(tab, range);
        }
        if shown.closed {
            self.uses = None;
            self.focus();
        }
    }

    fn find_bar(&mut self, ui: &mut Ui, out: &mut Outbox) {
        let take_focus = std::mem::take(&mut self.bar_takes_focus);
        let (Some(find), Some(editor)) = (&mut self.find, self.editors.get_mut(&self.current)) else { return };
        let before = editor.buffer.revision();
        let now = (self.current.clone(), editor.buffer.revision(), find.query.clone());
        if find.made_for.as_ref() != Some(&now) {
            find.matches = find.query.matches(editor.buffer.text());
            find.made_for = Some(now);
        }
        let (mut step, mut close) = (None, false);
        ui.horizontal_wrapped(|ui| {
            let field = ui.add(TextEdit::singleline(&mut find.query.text).hint_text("Find").desired_width(130.0));
            out.place("field:find", field.rect);
            if take_focus {
                field.request_focus();
            }
            if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
                step = Some(!ui.input(|i| i.modifiers.shift));
                field.request_focus();
            }
            ui.toggle_value(&mut find.query.match_case, "Aa").on_hover_text("Upper and lower case count");
            let at = find.matches.iter().position(|m| *m == editor.buffer.selection().range());
            let count = match (find.matches.len(), at) {
                (0, _) if find.query.text.is_empty() => String::new(),
                (0, _) => "none".into(),
                (n, Some(at)) => format!("{} of {n}", at + 1),
                (n, None) => n.to_string(),
            };
            ui.colored_label(theme::WEAK, count);
            if icons::button(ui, Icon::Previous, "Previous match").on_hover_text("Previous (Shift+Enter)").clicked() {
                step = Some(false);
            }
            if icons::button(ui, Icon::Next, "Next match").on_hover_text("Next (Enter)").clicked() {
                step = Some(true);
            }
            let field = ui.add(TextEdit::singleline(&mut find.with).hint_text("Replace with").desired_width(130.0));
            out.place("field:replace", field.rect);
            let some = !find.matches.is_empty();
            if ui.add_enabled(some, Button::new("Replace")).clicked() {
                editor.buffer.replace_match(&find.matches, &find.with);
                find.matches = find.query.matches(editor.buffer.text());
                step = Some(true);
            }
            if ui.add_enabled(some, Button::new("All")).on_hover_text("Replace all").clicked() {
                editor.buffer.replace_all(&find.matches, &find.with);
                find.matches = find.query.matches(editor.buffer.text());
            }
            close = icons::button(ui, Icon::Close, "Close").on_hover_text("Close (Esc)").clicked();
        });
        if let Some(forward) = step
            && editor.buffer.find(&find.matches, forward).is_some()
        {
            editor.reveal();
        }
        if editor.buffer.revision() != before {
            out.ask(Command::EditText { tab: self.current.clone(), text: editor.buffer.text().to_owned() });
        }
        if close || ui.input(|i| i.key_pressed(Key::Escape)) {
            self.find = None;
            self.focus();
        }
    }

    fn go_to_bar(&mut self, ui: &mut Ui) {
        let take_focus = std::mem::take(&mut self.bar_takes_focus);
        let Some(text) = &mut self.go_to_line else { return };
        let mut done = false;
        ui.horizontal(|ui| {
            ui.label("Line");
            let field = ui.add(TextEdit::singleline(text).hint_text("12 or 12:5").desired_width(90.0));
            if take_focus {
                field.request_focus();
            }
            let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            done = entered || ui.button("Go").clicked();
        });
        let place = parse_place(text);
        let closed = ui.input(|i| i.key_pressed(Key::Escape));
        if done || closed {
            self.go_to_line = None;
            match place.filter(|_| done) {
                Some(place) => self.go_to(self.current.clone(), Some(place)),
                None => self.focus(),
            }
        }
    }
}

/// `12` or `12:5`, counted from 1, as a place counted from 0.
fn parse_place(text: &str) -> Option<(usize, usize)> {
    let (line, column) = text.trim().split_once(':').unwrap_or((text.trim(), "1"));
    let from_0 = |s: &str| Some(s.trim().parse::<usize>().ok()?.saturating_sub(1));
    Some((from_0(line)?, from_0(column)?))
}

/// Returns whether two origins are one project: saving makes a manifest where there was none.
fn same_place(a: &Origin, b: &Origin) -> bool {
    match (a, b) {
        (Origin::Folder { path: a, .. }, Origin::Folder { path: b, .. }) => a == b,
        _ => a == b,
    }
}

fn marks(session: &Session, tab: &Tab) -> Vec<Mark> {
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
        })
    };
    session.diagnostics().iter().filter_map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_read_as_people_write_it() {
        assert_eq!(parse_place(" 12 "), Some((11, 0)));
        assert_eq!(parse_place("12:5"), Some((11, 4)));
        assert_eq!(parse_place("0"), Some((0, 0)));
        assert_eq!(parse_place("x"), None);
        assert_eq!(parse_place(""), None);
    }
}
