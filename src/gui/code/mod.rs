//! The editor's side of the window: the tab in front, its text, find and replace, and the list of problems below.

mod bars;
mod costs;
mod everywhere;
mod find_bar;
mod fixes;
mod menu;
mod places;
mod project_edits;
mod rename_bar;
mod requests;

use super::{
    actions::{Action, KeyFocus, Keymap},
    editor::{Buffer, CodeEditor, Debug, EditorAction, Help, Look, Query},
    panels::{Content, DefaultPlace, PanelContext, PanelRow},
    problems,
    tabs::{self, OpenFile},
    theme, toasts,
    ui_output::{ShellCommand, UiOutput},
    uses::Uses,
};
use crate::{
    project::{Origin, Tab},
    session::{EditCommand, Session, ViewCommand, probe::ProbePlace},
};
use egui::{Frame, Id, Margin, Panel, Ui};
use everywhere::ProjectMatches;
use find_bar::FindBar;
use fixes::{Fixes, FixesAction};
use rename_bar::RenameBar;
use std::{
    collections::{BTreeMap, HashMap},
    ops::Range,
};

pub(super) const PANEL: PanelRow = PanelRow {
    action: ("code-panel", "Panel: Code", &[], ""),
    is_open: true,
    ..PanelRow::new("code", "Code", DefaultPlace::Own, Content::WithRow(show))
};

fn show(ui: &mut Ui, context: &mut PanelContext<'_>) -> bool {
    context.code.show(ui, context.session, context.out)
}

#[derive(Default)]
pub(super) struct CodePanel {
    editors: HashMap<Tab, CodeEditor>,
    current: Tab,
    /// The included files that are open as tabs.
    files: Vec<OpenFile>,
    /// A compile was running: afterwards other tabs may include them.
    was_compiling: bool,
    /// The generation of the session's texts that the editors contain.
    generation: Option<u64>,
    /// The project to which the editors belong: undo must not lead back to another one.
    project: (String, Origin),
    font_size: f32,
    wraps: bool,
    find: FindBar,
    everywhere: ProjectMatches,
    fixes: Option<Fixes>,
    rename: Option<RenameBar>,
    /// The session's tabs.
    order: Vec<Tab>,
    go_to_line: Option<String>,
    bar_takes_focus: bool,
    /// The text takes the keyboard focus as soon as it is shown.
    takes_focus: bool,
    /// The number of shaders created so far; each new one takes the keyboard focus once.
    new_shaders: u64,
    /// The problem that was jumped to last.
    problem: Option<usize>,
    uses: Option<Uses>,
    /// The steps of undo that belong together, in the texts that an edit has changed.
    joined_steps: Vec<BTreeMap<Tab, u64>>,
    /// The front tab that was last reported to the session.
    reported_front: Option<Tab>,
    /// The number of the session's pass renames that have been applied.
    followed: usize,
    /// The debugger's marks in the tab in front.
    debug: Debug,
    /// The first byte of the word that is probed while the pointer is over it and Ctrl and Alt are held.
    pointed: Option<usize>,
}

impl CodePanel {
    pub(super) fn new() -> Self {
        Self { font_size: 13.0, ..Self::default() }
    }

    pub(super) fn current(&self) -> &Tab {
        &self.current
    }

    /// Returns the tab in front and the line of its caret, counted from 0.
    #[cfg(test)]
    pub(super) fn caret(&self) -> (Tab, usize) {
        let buffer = self.editors[&self.current].buffer();
        let before = &buffer.text()[..buffer.selection().range().start];
        (self.current.clone(), before.matches('\n').count())
    }

    /// Sets what the debugger shows in the tab in front.
    pub(super) fn set_debug(&mut self, debug: Debug) {
        self.debug = debug;
    }

    /// Scrolls a line of a tab, from 0, into view without moving the caret.
    pub(super) fn reveal_line(&mut self, tab: Tab, line: usize) {
        if let Some(editor) = self.editors.get_mut(&tab) {
            editor.reveal_line(line);
            self.bring(tab);
        }
    }

    /// Returns the tab in front with the byte and the line (from 0) of its caret.
    pub(super) fn caret_place(&self) -> Option<(Tab, usize, usize)> {
        let buffer = self.buffer()?;
        let head = buffer.selection().head;
        Some((self.current.clone(), head, buffer.line_of(head)))
    }

    /// Returns whether the text has the keyboard focus.
    pub(super) fn has_keys(&self, ctx: &egui::Context) -> bool {
        ctx.memory(|m| m.has_focus(Self::id(&self.current)))
    }

    pub(super) fn id(tab: &Tab) -> Id {
        Id::unique(("code", tab.title()))
    }

    /// Brings a tab to the front, and moves its caret to a line and column counted from 0.
    pub(super) fn go_to(&mut self, tab: Tab, place: Option<(usize, usize)>) {
        if let Some((line, column)) = place
            && let Some(editor) = self.editors.get_mut(&tab)
        {
            editor.go_to(line, column);
        }
        self.bring(tab);
    }

    /// Brings a tab to the front. An included file gets a tab by this.
    fn bring(&mut self, tab: Tab) {
        if let Tab::Included(_) = tab
            && !self.files.iter().any(|file| file.tab == tab)
        {
            self.files.push(OpenFile { tab: tab.clone(), users: Vec::new() });
            // The texts that include it are looked up in the next frame.
            self.was_compiling = true;
        }
        self.current = tab;
    }

    /// Closes the tab of an included file.
    pub(super) fn close_file(&mut self, tab: &Tab) {
        self.files.retain(|file| file.tab != *tab);
        if self.current == *tab {
            self.current = Tab::image();
        }
    }

    pub(super) fn switch_tab(&mut self, session: &Session, by: isize) {
        let tabs = tabs::shown(session, &self.files);
        if let Some(at) = tabs.iter().position(|t| *t == self.current) {
            let to = (at as isize + by).rem_euclid(tabs.len() as isize) as usize;
            self.current = tabs[to].clone();
            self.focus();
        }
    }

    /// Goes to the next or the previous problem, wrapping round at the ends of the list.
    pub(super) fn go_to_problem(&mut self, session: &Session, forward: bool) {
        let list = session.diagnostics();
        let count = list.len();
        let order = (1..=count).map(|step| match (self.problem.filter(|i| *i < count), forward) {
            (Some(at), true) => (at + step) % count,
            (Some(at), false) => (at + count - step) % count,
            (None, true) => step - 1,
            (None, false) => count - step,
        });
        let found = order.into_iter().find_map(|i| {
            let place = list[i].place.as_ref()?;
            Some((i, place.tab.clone()?, (place.line - 1, place.column - 1)))
        });
        if let Some((i, tab, place)) = found {
            self.problem = Some(i);
            self.go_to(tab, Some(place));
        }
    }

    pub(super) fn focus(&mut self) {
        self.takes_focus = true;
    }

    /// `size`: the font size in points; `wraps`: whether long lines wrap.
    pub(super) fn set_look(&mut self, size: f32, wraps: bool) {
        (self.font_size, self.wraps) = (size, wraps);
    }

    /// Opens the find bar with the selected text; `replaces`: also for replacing.
    pub(super) fn open_find(&mut self, replaces: bool) {
        let selected = self.editors.get(&self.current).map(|e| e.buffer().selected_text()).unwrap_or_default();
        self.find.open(selected, replaces);
        self.go_to_line = None;
        self.rename = None;
    }

    pub(super) fn is_finding(&self) -> bool {
        self.find.is_open()
    }

    /// Goes to the next or the previous match, even while the bar is closed.
    pub(super) fn find_next(&mut self, forward: bool) {
        if self.find.is_empty() {
            self.open_find(false);
        }
        if self.find.is_open() && self.find.is_everywhere() {
            return self.step_everywhere(forward);
        }
        if let Some(editor) = self.editors.get_mut(&self.current) {
            self.find.step(&self.current, editor, forward);
        }
    }

    pub(super) fn toggle_find_in_selection(&mut self) {
        if let Some(editor) = self.editors.get(&self.current) {
            self.find.toggle_scope(&self.current, editor);
        }
    }

    pub(super) fn switch_find(&mut self, switch: impl Fn(&mut Query)) {
        self.find.switch(switch);
    }

    pub(super) fn replace_all(&mut self, out: &mut UiOutput) {
        if self.find.is_everywhere() {
            return self.replace_everywhere(out);
        }
        if let Some(editor) = self.editors.get_mut(&self.current) {
            self.find.replace_all(&self.current, editor);
        }
        self.report_changed(out);
    }

    /// Applies an action of a key or the palette to the text in front.
    pub(super) fn act(&mut self, action: EditorAction, out: &mut UiOutput) {
        if let Some(editor) = self.editors.get_mut(&self.current) {
            editor.act(action);
            editor.focus();
        }
        self.follow_undo();
        self.report_changed(out);
    }

    pub(super) fn open_go_to_line(&mut self) {
        self.go_to_line = Some(String::new());
        self.find.close();
        self.rename = None;
        self.bar_takes_focus = true;
    }

    /// Takes over texts that were changed outside the editors.
    pub(super) fn prepare(&mut self, session: &Session) {
        let project = session.project();
        if std::mem::replace(&mut self.new_shaders, session.new_shader_count()) != session.new_shader_count() {
            self.takes_focus = true;
        }
        if self.project.0 != project.name || !same_place(&self.project.1, &project.origin) {
            let moved = self.project.1 == Origin::Unsaved || self.project.0 != project.name;
            // Saving under a new name keeps the texts, and so their undo.
            let is_same = |(tab, e): (&Tab, &CodeEditor)| session.text(tab) == e.buffer().text();
            let kept = moved && !self.editors.is_empty() && self.editors.iter().all(is_same);
            if !kept {
                self.editors.clear();
                self.files.clear();
                self.problem = None;
                self.uses = None;
                self.joined_steps.clear();
                (self.rename, self.fixes, self.go_to_line) = (None, None, None);
                self.find.close();
                self.bring(project.main_tab());
            }
            self.project = (project.name.clone(), project.origin.clone());
        }
        self.follow_renames(session);
        let tabs = session.tabs();
        self.order.clone_from(&tabs);
        // The undo of an included file is kept while the line that includes it is edited.
        let is_kept = |tab: &Tab| tabs.contains(tab) || matches!(tab, Tab::Included(_));
        let is_complete = tabs.iter().all(|tab| self.editors.contains_key(tab)) && self.editors.keys().all(is_kept);
        if self.generation != Some(session.text_generation()) || !is_complete {
            self.generation = Some(session.text_generation());
            self.editors.retain(|tab, _| is_kept(tab));
            for tab in &tabs {
                let text = session.text(tab);
                match self.editors.get_mut(tab) {
                    Some(editor) => editor.take_text(text),
                    None => drop(self.editors.insert(tab.clone(), CodeEditor::new(text))),
                }
            }
        }
        if !tabs.contains(&self.current) {
            self.current = Tab::image();
        }
        let is_compiling = session.compile_state().compiling;
        if std::mem::replace(&mut self.was_compiling, is_compiling) && !is_compiling {
            for file in &mut self.files {
                file.users = session.project().tabs_that_include(&file.tab);
            }
        }
    }

    /// Keeps the editor of a renamed pass, with its caret and its undo.
    fn follow_renames(&mut self, session: &Session) {
        for (from, to) in session.renamed_passes().iter().skip(self.followed) {
            let tabs: Vec<Tab> = self.editors.keys().filter(|tab| tab.pass() == Some(from)).cloned().collect();
            for tab in tabs {
                let new = tab.of_pass(to.clone());
                if let Some(editor) = self.editors.remove(&tab) {
                    self.editors.insert(new.clone(), editor);
                }
                if self.current == tab {
                    self.current = new;
                }
            }
        }
        self.followed = session.renamed_passes().len();
    }

    /// Fills the available space. Returns true if a drag of the row of tabs starts, which moves the panel.
    pub(super) fn show(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) -> bool {
        ui.spacing_mut().item_spacing.y = 0.0;
        let is_dragged = tabs::show(ui, session, &self.current, &self.files, out);
        let bar = Frame::NONE.fill(theme::of(ui).raised).inner_margin(Margin::symmetric(8, 5));
        if self.find.is_open() {
            bar.show(ui, |ui| {
                ui.set_width(ui.available_width());
                self.find_bar(ui, out);
            });
        } else if self.rename.is_some() {
            bar.show(ui, |ui| {
                ui.set_width(ui.available_width());
                self.rename_bar(ui, session, out);
            });
        } else if self.go_to_line.is_some() {
            bar.show(ui, |ui| {
                ui.set_width(ui.available_width());
                self.go_to_bar(ui, out);
            });
        }
        self.look_everywhere();
        if let Some(fixes) = &mut self.fixes
            && Self::has_focus(ui, &self.current)
        {
            let chosen = fixes.take_keys(ui);
            self.choose_fix(chosen, out);
        }
        // Problems and notices leave two thirds to the code.
        let limit = ui.available_height() / 3.0;
        let room = limit - problems::STATE - if session.notices().is_empty() { 0.0 } else { toasts::ROW };
        let problems = problems::panel(ui, session, self.caret_line(), room.min(150.0), out);
        toasts::panel(ui, session, limit - problems, out);
        self.show_uses(ui, session, out);
        if self.reported_front.as_ref() != Some(&self.current) {
            self.reported_front = Some(self.current.clone());
            out.ask(EditCommand::BringToFront(self.current.clone()));
        }
        self.editor(ui, session, out);
        is_dragged
    }

    fn editor(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        let marks = places::marks(session, &self.current);
        let shared = if self.current == Tab::Common { "" } else { session.text(&Tab::Common) };
        let Some(editor) = self.editors.get_mut(&self.current) else { return };
        if std::mem::take(&mut self.takes_focus) {
            editor.focus();
        }
        let analysis = session.analysis().filter(|a| a.front == self.current);
        let help = analysis.and_then(|a| {
            let source = a.source_of(&self.current)?;
            Some(Help { analysis: &a.analysis, source, classes: &a.classes, text: a.text() })
        });
        let (font_size, wraps) = (self.font_size, self.wraps);
        let costs = costs::of_lines(session, &self.current, editor.buffer().text());
        let name = format!("Code of {}", self.current.title());
        let look = Look {
            name: &name,
            font_size,
            wraps,
            marks: &marks,
            matches: self.find.matches(),
            shared,
            help,
            debug: &self.debug,
            costs: &costs,
        };
        let keymap = out.keys.clone();
        out.home("code", ui, Self::id(&self.current));
        let shown = editor.show(ui, Self::id(&self.current), look, &|event| of_code(&keymap, event));
        out.place("editor", shown.text_rect);
        out.place("code", shown.focus_rect);
        for (line, rect) in shown.marked {
            out.place(format!("mark:{}", line + 1), rect);
        }
        self.follow_undo();
        self.report_changed(out);
        if let Some(line) = shown.clicked_line {
            out.shell_commands.push(ShellCommand::Breakpoint(self.current.clone(), line));
        }
        self.point(shown.pointed, out);
        for (name, rect) in shown.placed {
            out.place(name, rect);
        }
        let has_fix = self.caret_line().is_some_and(|(_, line)| marks.iter().any(|m| m.line == line && m.has_fix));
        if let Some(response) = &shown.response {
            menu::show(response, session, has_fix, out);
        }
        for request in shown.requests {
            self.answer(session, request, out);
            ui.ctx().request_repaint();
        }
        let (here, has_keys) = (self.fixed_at(), self.has_keys(ui.ctx()));
        if let (Some(fixes), Some(now)) = (&self.fixes, here) {
            let chosen = if has_keys { fixes.show(ui, shown.caret, &now, out) } else { FixesAction::Closed };
            self.choose_fix(chosen, out);
        }
    }

    /// Probes the word below the pointer, and stops when there is none.
    fn point(&mut self, at: Option<usize>, out: &mut UiOutput) {
        let word = at.and_then(|at| Some(self.buffer()?.word_at(at).start));
        if word != self.pointed {
            self.pointed = word;
            let tab = self.current.clone();
            out.ask(ViewCommand::Probe(word.map(|at| ProbePlace { tab, at, visit: 0 })));
        }
    }

    /// Selects bytes of a tab's text.
    fn show_range(&mut self, tab: Tab, range: Range<usize>) {
        if let Some(editor) = self.editors.get_mut(&tab) {
            editor.show_range(range);
            self.bring(tab);
        }
    }

    fn show_uses(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        let Some(uses) = &mut self.uses else { return };
        let frame = Frame::NONE.fill(theme::of(ui).panel);
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

    fn buffer(&self) -> Option<&Buffer> {
        self.editors.get(&self.current).map(CodeEditor::buffer)
    }

    /// Returns the tab in front and the line of its caret, counted from 0.
    fn caret_line(&self) -> Option<(&Tab, usize)> {
        let buffer = self.buffer()?;
        Some((&self.current, buffer.line_of(buffer.selection().head)))
    }
}

/// Returns whether two origins are the same project: saving creates a manifest if there was none.
fn same_place(a: &Origin, b: &Origin) -> bool {
    match (a, b) {
        (Origin::Folder { path: a, .. }, Origin::Folder { path: b, .. }) => a == b,
        _ => a == b,
    }
}

/// Returns the action of the code that a key triggers while the code has the keyboard focus.
fn of_code(keymap: &Keymap, event: &egui::Event) -> Option<EditorAction> {
    match keymap.pressed(event, KeyFocus { code: true, ..KeyFocus::default() })?.action {
        Action::Code(action) => Some(action),
        _ => None,
    }
}
