//! The window of passes: their order, and how each is drawn and read.
//!
//! Owns the selection and what is typed here. Changes are edits of the session, which can be undone.

mod detail;
mod fills;
mod list;

use super::{
    accessible,
    actions::Action,
    menus, theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    project::{PassName, Role, Tab},
    session::{EditCommand, Session},
};
use detail::Typed;
use egui::{Frame, Id, Margin, Response, RichText, Ui, Window, WindowDrag, vec2};

/// The width of the list; the rest is for the selected pass.
const LIST: f32 = 196.0;
const SIZE: egui::Vec2 = vec2(600.0, 486.0);

#[derive(Debug, Default)]
pub(super) struct Passes {
    open: bool,
    chosen: Option<Tab>,
    typed: Typed,
    /// The number of the session's pass renames that have been applied.
    followed: usize,
}

impl Passes {
    /// Opens the window on a pass; if none is named and it is open, closes it.
    pub(super) fn toggle(&mut self, tab: Option<Tab>) {
        self.open = tab.is_some() || !self.open;
        if tab.is_some() {
            self.chosen = tab;
        }
    }

    /// `current`: the tab in front, which is selected initially.
    pub(super) fn show(&mut self, ui: &Ui, session: &Session, current: &Tab, out: &mut UiOutput) {
        if !self.open {
            return;
        }
        self.follow(session, current);
        let mut open = true;
        let screen = ui.ctx().content_rect();
        let size = SIZE.min(screen.size() - vec2(40.0, 90.0)).max(vec2(300.0, 160.0));
        let window = Window::new(RichText::new("Passes").size(15.0))
            .id(Id::unique("passes"))
            .open(&mut open)
            .collapsible(false)
            // A draggable title would take the keyboard focus, and have no name.
            .drag_area(WindowDrag::Anywhere)
            .title_frame(Frame::window(ui.style()).inner_margin(Margin::symmetric(16, 9)))
            .resizable(true)
            .default_size(size)
            .min_size(vec2(320.0, 180.0))
            .default_pos(screen.left_top() + vec2(24.0, 56.0))
            .constrain_to(screen);
        let shown = window.show(ui.ctx(), |ui| {
            ui.set_min_size(ui.available_size());
            out.stop("passes", ui);
            self.contents(ui, session, out);
        });
        if let Some(shown) = shown {
            out.place("passes", shown.response.rect);
            let of_window = |id| ui.ctx().read_response(id).is_some_and(|r| r.layer_id == shown.response.layer_id);
            let is_front = ui.ctx().memory(|m| m.focused()).is_none_or(of_window);
            if is_front && ui.input(|i| i.key_pressed(egui::Key::Escape)) {
                open = false;
            }
        }
        self.open = open;
    }

    /// Keeps the selection when its pass is renamed, and moves it to an existing one.
    fn follow(&mut self, session: &Session, current: &Tab) {
        for (from, to) in session.renamed_passes().iter().skip(self.followed) {
            if let Some(tab) = self.chosen.as_mut().filter(|tab| tab.pass() == Some(from)) {
                *tab = tab.of_pass(to.clone());
            }
        }
        self.followed = session.renamed_passes().len();
        if self.chosen.as_ref().is_none_or(|tab| session.project().source(tab).is_none()) {
            self.chosen = Some(current.pass().map_or(Tab::Common, |id| Tab::Pass(id.clone())));
        }
    }

    fn contents(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        tools(ui, session, out);
        ui.add_space(2.0);
        let room = ui.available_rect_before_wrap();
        let wide = room.width() > 460.0;
        let tab = self.chosen.clone().unwrap_or(Tab::image());
        if wide {
            let list = egui::Rect::from_min_size(room.min, vec2(LIST, room.height()));
            let rest = egui::Rect::from_min_max(egui::pos2(list.right() + 14.0, room.top()), room.max);
            ui.scope_builder(egui::UiBuilder::new().max_rect(list), |ui| self.list(ui, session, &tab, out));
            ui.painter().vline(list.right() + 7.0, room.y_range(), egui::Stroke::new(1.0, theme::of(ui).line));
            ui.scope_builder(egui::UiBuilder::new().max_rect(rest), |ui| self.detail(ui, session, &tab, out));
            ui.advance_cursor_after_rect(room);
        } else {
            egui::ScrollArea::vertical().id_salt("narrow passes").show(ui, |ui| {
                self.list(ui, session, &tab, out);
                ui.separator();
                self.detail(ui, session, &tab, out);
            });
        }
    }

    fn list(&mut self, ui: &mut Ui, session: &Session, tab: &Tab, out: &mut UiOutput) {
        if let Some(tab) = list::show(ui, session, tab, out) {
            self.chosen = Some(tab);
        }
    }

    fn detail(&mut self, ui: &mut Ui, session: &Session, tab: &Tab, out: &mut UiOutput) {
        egui::ScrollArea::vertical().id_salt("pass detail").auto_shrink(false).show(ui, |ui| {
            detail::show(ui, session, tab, &mut self.typed, out);
        });
    }
}

/// Shows the buttons that add a pass, undo and redo.
fn tools(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    ui.horizontal(|ui| {
        let add = adding(ui, "Add", |ui| add_menu(ui, session, true, out));
        out.place("passes:add", add.rect);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let redo = session.pass_redo().map(|step| step.title.to_owned());
            let undo = session.pass_undo().map(|step| step.title.to_owned());
            for (name, label, title, action) in
                [("passes:redo", "Redo", redo, Action::RedoPasses), ("passes:undo", "Undo", undo, Action::UndoPasses)]
            {
                let button = ui.add_enabled(title.is_some(), egui::Button::new(label));
                out.on_click(name, &button, action);
                let tip = format!("{label}: {}", title.as_deref().unwrap_or("nothing"));
                button.on_hover_text(out.keys.tip(&tip, action)).on_disabled_hover_text(format!("Nothing to {label}"));
            }
        });
    });
}

/// Shows a button with a menu that stays open during typing.
pub(super) fn adding(ui: &mut Ui, label: &str, contents: impl FnOnce(&mut Ui)) -> Response {
    let button = ui.button(label);
    menus::below(&button, contents);
    button
}

/// Shows the passes that can be added: those of Shadertoy, and a buffer of any name. `chooses`: the window of passes
/// is open, and the new pass is selected in it; otherwise nothing opens over the picture.
pub(super) fn add_menu(ui: &mut Ui, session: &Session, chooses: bool, out: &mut UiOutput) {
    let id = Id::unique("name of a new buffer");
    ui.set_min_width(190.0);
    let add = |ui: &mut Ui, tab: Tab, out: &mut UiOutput| {
        out.ask(EditCommand::AddTab(tab.clone()));
        out.shell_commands.push(ShellCommand::GoTo(tab.clone(), None));
        if chooses {
            out.shell_commands.push(ShellCommand::ChoosePass(tab));
        }
        ui.data_mut(|d| d.remove_temp::<String>(id));
        ui.close();
    };
    for tab in addable(&session.tabs()) {
        let item = ui.button(tab.title());
        if out.clicked(&format!("add:{}", tab.title()), &item) {
            add(ui, tab, out);
        }
    }
    ui.separator();
    ui.label(RichText::new("Add a buffer with a name of your own").color(theme::of(ui).weak).small());
    let mut name = ui.data_mut(|d| d.get_temp_mut_or_default::<String>(id).clone());
    ui.horizontal(|ui| {
        let field = ui.add(egui::TextEdit::singleline(&mut name).hint_text("velocity").desired_width(110.0));
        accessible::name(&field, egui::Role::TextInput, "Name of the new buffer");
        out.place("add:name", field.rect);
        let wanted = PassName::buffer_named(&name).map(Tab::Pass);
        let is_free = wanted.as_ref().is_some_and(|tab| !session.tabs().contains(tab));
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        let button = ui.add_enabled(is_free, egui::Button::new("Add"));
        let clicked = out.clicked("add:named", &button);
        let why = match &wanted {
            None => PassName::NAMES.to_owned(),
            Some(tab) => format!("{} already exists", tab.title()),
        };
        button.on_disabled_hover_text(why);
        if let Some(tab) = wanted.filter(|_| is_free && (entered || clicked)) {
            name.clear();
            add(ui, tab, out);
        }
    });
    ui.data_mut(|d| d.insert_temp(id, name));
}

/// Returns Common, those of Shadertoy's four buffers that do not exist yet or else the next letter, the cubemap and
/// the sound pass.
fn addable(tabs: &[Tab]) -> Vec<Tab> {
    let buffer = |c: char| Tab::Pass(PassName::buffer(c.to_string()));
    let is_free = |tab: &Tab| !tabs.contains(tab);
    let mut buffers: Vec<Tab> = ('A'..='D').map(buffer).filter(is_free).collect();
    if buffers.is_empty() {
        buffers.extend(('E'..='Z').map(buffer).find(is_free));
    }
    let others =
        Role::all().filter_map(Role::only_pass).map(Tab::Pass).filter(|tab| *tab != Tab::image() && is_free(tab));
    std::iter::once(Tab::Common).filter(is_free).chain(buffers).chain(others).collect()
}

/// Returns the next buffer: Shadertoy's four, then further letters.
pub(super) fn next_buffer(tabs: &[Tab]) -> Option<Tab> {
    addable(tabs).into_iter().find(Tab::is_buffer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fifth_buffer_is_offered_after_four() {
        let tab = |id: PassName| Tab::Pass(id);
        let buffer = |name: &str| tab(PassName::buffer(name));
        let (cube, sound) = (tab(PassName::cube()), tab(PassName::sound()));
        let there = [buffer("B"), cube.clone()];
        assert_eq!(addable(&there), [Tab::Common, buffer("A"), buffer("C"), buffer("D"), sound.clone()]);
        let full = ["A", "B", "C", "D", "E"].map(buffer).into_iter().chain([Tab::Common]).collect::<Vec<_>>();
        assert_eq!(addable(&full), [buffer("F"), cube, sound]);
    }
}
