//! The row of tabs over the editor.

use super::{
    accessible,
    actions::Action,
    icons::{self, Icon},
    menus,
    panels::Panel,
    passes, theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    diag::Severity,
    project::{PassEdit, Tab, listed},
    session::{EditCommand, Session, ViewCommand},
};
use egui::{Align2, FontId, Rect, ScrollArea, Sense, Stroke, Ui, pos2, style::ScrollAnimation, vec2};

const HEIGHT: f32 = 32.0;
/// The width of the button after the tabs.
const ADD: f32 = 36.0;
/// The width of the sign that closes a tab.
const CLOSE: f32 = 18.0;

/// An included file that is open as a tab, and the tabs whose texts include it.
#[derive(Clone, Debug)]
pub(super) struct OpenFile {
    pub tab: Tab,
    pub users: Vec<Tab>,
}

impl OpenFile {
    /// Returns which other texts an edit of it affects.
    fn shared(&self) -> String {
        match &self.users[..] {
            [] => "No pass includes this file".to_owned(),
            users => format!("Included by {}", listed(&users.iter().map(Tab::title).collect::<Vec<_>>())),
        }
    }
}

/// Returns the tabs to show: the project's own, and those of the included files that are open or not saved.
pub(super) fn shown(session: &Session, files: &[OpenFile]) -> Vec<Tab> {
    let is_open = |tab: &Tab| files.iter().any(|file| file.tab == *tab) || session.is_tab_dirty(tab);
    session.tabs().into_iter().filter(|tab| !matches!(tab, Tab::Included(_)) || is_open(tab)).collect()
}

/// Shows the tabs; `current` has the accent colour. `files`: the included files that are open. Returns true if the
/// empty part of the row is dragged.
pub(super) fn show(ui: &mut Ui, session: &Session, current: &Tab, files: &[OpenFile], out: &mut UiOutput) -> bool {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    // Below the tabs, which are added later. It also takes clicks, so that a click does not start a drag.
    let handle = ui.interact(rect, ui.scope_id().with("tab row"), Sense::CLICK | Sense::DRAG);
    ui.painter().rect_filled(rect, 0.0, theme::of(ui).panel);
    ui.painter().hline(rect.x_range(), rect.bottom() - 0.5, Stroke::new(1.0, theme::of(ui).line));
    let mut row =
        ui.new_child(egui::UiBuilder::new().max_rect(rect).layout(egui::Layout::left_to_right(egui::Align::Center)));
    out.stop("tabs", &row);
    row.spacing_mut().item_spacing.x = 4.0;
    // The button for a new tab stays next to them, however many there are.
    ScrollArea::horizontal()
        .id_salt("tabs")
        .max_width((row.available_width() - ADD).max(0.0))
        .auto_shrink([true, false])
        .scroll_bar_visibility(egui::scroll_area::ScrollBarVisibility::AlwaysHidden)
        .show(&mut row, |ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            scroll_by_wheel(ui, rect);
            let tabs = shown(session, files);
            for tab in &tabs {
                let file = files.iter().find(|file| file.tab == *tab);
                show_tab(ui, session, tab, file, tab == current, out);
            }
            keep_visible(ui, &tabs, current, out);
        });
    add_menu(&mut row, session, out);
    handle.drag_started()
}

/// Scrolls the horizontal row of tabs by a vertical wheel.
fn scroll_by_wheel(ui: &Ui, row: Rect) {
    let wheel = ui.input(|i| i.smooth_scroll_delta());
    if wheel.x == 0.0 && wheel.y != 0.0 && ui.rect_contains_pointer(row) {
        ui.scroll_with_delta_animation(vec2(wheel.y, 0.0), ScrollAnimation::none());
    }
}

/// Scrolls the current tab into view when it comes to the front, moves or grows; otherwise the scroll position is the
/// user's.
fn keep_visible(ui: &Ui, tabs: &[Tab], current: &Tab, out: &UiOutput) {
    let Some(rect) = out.places.get(&format!("tab:{}", current.title())) else { return };
    // A panel that opens may move the row to another `Ui`, where it is not scrolled yet.
    let id = ui.scope_id().with("current tab");
    // Another project may have a tab of this name in another position, and another layout another width of the row.
    let widths = [rect.width(), ui.clip_rect().width()].map(f32::to_bits);
    let now = (current.title(), widths, tabs.iter().position(|tab| tab == current), tabs.len());
    if ui.data_mut(|d| d.get_temp::<(String, [u32; 2], Option<usize>, usize)>(id)).as_ref() != Some(&now) {
        ui.data_mut(|d| d.insert_temp(id, now));
        ui.scroll_to_rect_animation(*rect, None, ScrollAnimation::none());
    }
}

fn show_tab(ui: &mut Ui, session: &Session, tab: &Tab, file: Option<&OpenFile>, is_current: bool, out: &mut UiOutput) {
    let here = session.diagnostics().iter().filter(|d| d.tab() == Some(tab));
    let (mut errors, mut warnings) = (0, 0);
    for d in here {
        match d.severity {
            Severity::Error => errors += 1,
            Severity::Warning => warnings += 1,
            Severity::Note => {}
        }
    }
    let dirty = session.is_tab_dirty(tab);
    let color = if is_current { theme::of(ui).strong } else { theme::of(ui).weak };
    let title = ui.painter().layout_no_wrap(tab.title(), FontId::proportional(13.0), color);
    let badge = match (errors, warnings) {
        (0, 0) => None,
        (0, n) => Some((n, theme::of(ui).warning)),
        (n, _) => Some((n, theme::of(ui).error)),
    };
    // An edit of it affects several passes.
    let note = file.filter(|file| file.users.len() != 1).map(|file| {
        ui.painter().layout_no_wrap(
            format!("{} passes", file.users.len()),
            FontId::proportional(11.0),
            theme::of(ui).weak,
        )
    });
    let note_width = note.as_ref().map_or(0.0, |note| note.size().x + 8.0);
    let is_included = matches!(tab, Tab::Included(_));
    let can_close = is_included && !dirty;
    let extra = if badge.is_some() { 24.0 } else { 0.0 }
        + if dirty { 12.0 } else { 0.0 }
        + if can_close { CLOSE } else { 0.0 }
        + note_width;
    let (rect, response) = ui.allocate_exact_size(vec2(title.size().x + 24.0 + extra, HEIGHT), Sense::click());
    let name = file.map_or_else(|| tab.title(), |file| format!("{}: {}", tab.title(), file.shared()));
    accessible::choice(&response, egui::Role::Tab, is_current, name);
    if is_current {
        ui.painter().rect_filled(rect, 0.0, theme::of(ui).background);
        ui.painter().hline(rect.x_range(), rect.top() + 1.0, Stroke::new(2.0, theme::of(ui).accent));
    } else if response.hovered() {
        ui.painter().rect_filled(rect, 0.0, theme::of(ui).raised);
    }
    let mut x = rect.left() + 12.0;
    let width = title.size().x;
    ui.painter().galley(pos2(x, rect.center().y - title.size().y / 2.0), title, color);
    x += width;
    if let Some(note) = note {
        ui.painter().galley(pos2(x + 8.0, rect.center().y - note.size().y / 2.0), note, color);
        x += note_width;
    }
    if dirty {
        ui.painter().circle_filled(pos2(x + 9.0, rect.center().y), 3.0, theme::of(ui).accent);
        x += 12.0;
    }
    if let Some((count, fill)) = badge {
        let place = Rect::from_center_size(pos2(x + 15.0, rect.center().y), vec2(17.0, 15.0));
        ui.painter().rect_filled(place, 7.0, fill);
        let text = if count > 99 { "99".to_owned() } else { count.to_string() };
        ui.painter().text(
            place.center(),
            Align2::CENTER_CENTER,
            text,
            FontId::proportional(10.5),
            theme::of(ui).background,
        );
    }
    let closes = can_close && {
        let place = Rect::from_center_size(pos2(rect.right() - 14.0, rect.center().y), vec2(18.0, 18.0));
        let close = icons::flat_at(ui, place, Icon::Close, &format!("Close {}", tab.title()));
        out.clicked(&format!("tab:close:{}", tab.title()), &close)
    };
    let is_middle = response.clicked_by(egui::PointerButton::Middle) && can_close;
    if closes || is_middle {
        out.shell_commands.push(ShellCommand::CloseFile(tab.clone()));
    } else if out.clicked(&format!("tab:{}", tab.title()), &response) {
        out.shell_commands.push(ShellCommand::GoTo(tab.clone(), None));
    }
    menus::context(&response, |ui| {
        if let Tab::Pass(id) = tab
            && ui.button("Show this pass").clicked()
        {
            out.ask(ViewCommand::ShowPass(id.clone()));
        }
        if let Some(id) = tab.pass()
            && ui.button("Name, size, format, steps…").clicked()
        {
            out.shell_commands.push(ShellCommand::ChoosePass(Tab::Pass(id.clone())));
        }
        let can_go = *tab != Tab::image();
        if is_included {
            let close = ui.add_enabled(can_close, egui::Button::new("Close tab"));
            if close.on_disabled_hover_text("Save it first").clicked() {
                out.shell_commands.push(ShellCommand::CloseFile(tab.clone()));
            }
        } else if ui.add_enabled(can_go, egui::Button::new(format!("Remove {}", tab.title()))).clicked() {
            out.ask(EditCommand::EditPasses(PassEdit::Remove(tab.clone())));
        }
        ui.separator();
        let close = ui.button("Close code");
        out.on_click(
            "tab:close-code",
            &close.on_hover_text("Reopen it from the View menu"),
            ShellCommand::ClosePanel(Panel::Code),
        );
    });
    // While paused there are no current times.
    let times = if session.transport().playing { session.pass_times() } else { &[] };
    let time = times.iter().find(|t| *tab == Tab::Pass(t.pass.clone()));
    let included = file;
    let file = session.project().source(tab).and_then(|s| s.path.as_ref());
    response.on_hover_ui(|ui| {
        ui.label(tab.title());
        if let Some(included) = included {
            ui.label(included.shared());
        }
        if let Some(path) = file {
            ui.colored_label(theme::of(ui).weak, path.display().to_string());
        }
        if let Some(time) = time {
            ui.label(format!("{:.3} ms on the GPU", time.gpu_millis));
        }
        if dirty {
            ui.colored_label(theme::of(ui).accent, "Not saved");
        }
        if *tab != Tab::image() && !is_included {
            ui.colored_label(theme::of(ui).weak, "Right-click or Shift+F10 for more");
        }
    });
}

fn add_menu(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let menu = passes::adding(ui, "+", |ui| {
        passes::add_menu(ui, session, false, out);
        ui.separator();
        let all = ui.button("All passes…");
        out.on_menu_click(ui, "add:passes", &all, Action::Passes);
    });
    out.place("button:add-tab", menu.rect);
    menu.on_hover_text("Add Common or a buffer");
}
