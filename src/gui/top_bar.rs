//! The bar at the top: gallery, new, open, save, the project's name, the View menu, help.

use super::{
    actions::Action,
    export_menu,
    icons::{self, Icon},
    menus,
    panels::Panel,
    settings::{Change, Settings, Theme},
    theme,
    ui_output::{Pick, ShellCommand, UiOutput},
};
use crate::{project::Origin, session::Session};
use egui::{
    Align, Align2, Button, FontId, Layout, PopupCloseBehavior, Sense, Ui,
    containers::menu::{MenuButton, MenuConfig},
};
use std::collections::BTreeSet;

/// The window's state that the bar shows.
pub(super) struct State<'a> {
    pub is_gallery: bool,
    /// The lab has results to export.
    pub has_lab_results: bool,
    pub open: &'a BTreeSet<Panel>,
    pub settings: &'a Settings,
}

/// Below this width the bar omits what can be done elsewhere.
const ROOMY: f32 = 700.0;
/// Below this width it also omits the export menu, whose entries are in the palette.
const COMPACT: f32 = 440.0;

pub(super) fn show(ui: &mut Ui, session: &Session, state: &State<'_>, out: &mut UiOutput) {
    out.stop("top", ui);
    ui.spacing_mut().item_spacing.x = 4.0;
    let width = ui.available_width();
    ui.horizontal_centered(|ui| {
        let item =
            |ui: &mut Ui, name: &str, label: &str, tip: &str, action: Action, selected: bool, out: &mut UiOutput| {
                let response = ui.add(Button::new(label).selected(selected));
                let response = response.on_hover_text(out.keys.tip(tip, action));
                out.on_click(name, &response, action);
            };
        item(ui, "button:gallery", "Gallery", "Presets to start from", Action::Gallery, state.is_gallery, out);
        item(ui, "button:new", "New", "Create a shader with one Image pass", Action::New, false, out);
        let menu = ui.menu_button("Open", |ui| {
            let folder = ui.button("Folder…").on_hover_text("Open a folder with eddy.toml or .glsl files");
            out.on_menu_click(ui, "open:folder", &folder, ShellCommand::Pick(Pick::OpenFolder));
            let file = Button::new("File…").shortcut_text(out.keys.hint(Action::Open));
            let file = ui.add(file).on_hover_text("Open a .glsl file or a Shadertoy .json file");
            out.on_menu_click(ui, "open:file", &file, Action::Open);
            if !state.is_gallery {
                let recording = Button::new("Recording…").shortcut_text(out.keys.hint(Action::PlayRecording));
                let recording = ui.add(recording).on_hover_text("Play a .replay file in this project");
                out.on_menu_click(ui, "open:recording", &recording, Action::PlayRecording);
            }
            ui.separator();
            let page = ui.button("Get shaders from Shadertoy…");
            let page = page.on_hover_text("Open a page with a bookmarklet that saves a shader's JSON in your browser");
            out.on_menu_click(ui, "open:bookmarklet", &page, Action::Bookmarklet);
        });
        out.place("button:open", menu.response.rect);
        if !state.is_gallery {
            item(ui, "button:save", "Save", "Save the project", Action::Save, false, out);
            if width > ROOMY {
                let tip = "Save the project to another folder";
                item(ui, "button:save-as", "Save as", tip, Action::SaveAs, false, out);
            }
            if width > COMPACT {
                export_menu::show(ui, session, state.has_lab_results, out);
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            item(ui, "button:help", "?", "Help and keyboard shortcuts", Action::Help, false, out);
            if !state.is_gallery {
                let full = icons::button(ui, Icon::Expand, "Full screen")
                    .on_hover_text(out.keys.tip("Full screen", Action::Fullscreen));
                out.on_click("button:fullscreen", &full, Action::Fullscreen);
                let present = icons::button(ui, Icon::Present, "Code over picture")
                    .on_hover_text(out.keys.tip("Code over picture", Action::Present));
                out.on_click("button:present", &present, Action::Present);
            }
            view_menu(ui, state, out);
            if width > ROOMY {
                let is_on = state.open.contains(&Panel::Lab) && !state.is_gallery;
                item(
                    ui,
                    "button:lab",
                    "Lab",
                    "Compare methods: speed against error",
                    Action::Panel(Panel::Lab),
                    is_on,
                    out,
                );
            }
            if !state.is_gallery {
                name(ui, session);
            }
        });
    });
}

/// Offers which parts of the window are shown, and how.
fn view_menu(ui: &mut Ui, state: &State<'_>, out: &mut UiOutput) {
    // The menu stays open because one often changes several entries.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = MenuButton::new("View").config(config).ui(ui, |ui| {
        ui.set_min_width(230.0);
        for panel in Panel::all() {
            let action = Action::Panel(panel);
            let is_open = state.open.contains(&panel) && !state.is_gallery;
            let entry = menus::switch(ui, is_open, panel.title(), out.keys.hint(action));
            out.on_menu_click(ui, &format!("view:{}", panel.name()), &entry, action);
        }
        let mut item = |ui: &mut Ui, name: &str, label: &str, action: Action| {
            let entry = menus::entry(ui, label, out.keys.hint(action));
            out.on_menu_click(ui, name, &entry, action);
        };
        item(ui, "view:usual", "Reset layout", Action::ResetLayout);
        ui.separator();
        item(ui, "view:present", "Code over picture", Action::Present);
        item(ui, "view:full-screen", "Full screen", Action::Fullscreen);
        ui.separator();
        ui.horizontal(|ui| {
            ui.label("Theme");
            for theme in Theme::ALL {
                let choice = ui.add(Button::selectable(state.settings.theme == theme, theme.title()));
                let choice = choice.on_hover_text(Action::Theme(theme).title());
                out.on_click(&format!("theme:{}", theme.name()), &choice, ShellCommand::Set(Change::Theme(theme)));
            }
        });
        ui.horizontal(|ui| {
            ui.label("Zoom");
            let percent = format!("{:.0} %", state.settings.zoom * 100.0);
            for (name, label, action) in [
                ("zoom:out", "−", Action::ZoomOut),
                ("zoom:usual", percent.as_str(), Action::ZoomReset),
                ("zoom:in", "+", Action::ZoomIn),
            ] {
                let button = ui.button(label).on_hover_text(out.keys.tip(action.title(), action));
                out.on_click(name, &button, action);
            }
        });
        ui.separator();
        let wraps = menus::switch(ui, state.settings.word_wrap, "Word wrap", out.keys.hint(Action::WordWrap));
        out.on_menu_click(ui, "view:word-wrap", &wraps, Action::WordWrap);
        let all = menus::entry(ui, "Settings…", out.keys.hint(Action::Settings));
        out.on_menu_click(ui, "view:settings", &all, Action::Settings);
    });
    out.place("button:view", button.rect);
    button.on_hover_text("Panels, layout, theme, zoom and settings");
}

/// Shows the project's name in the remaining room, with a dot while it is not saved.
fn name(ui: &mut Ui, session: &Session) {
    let p = theme::of(ui);
    let project = session.project();
    let (rect, response) = ui.allocate_exact_size(egui::vec2(ui.available_width(), 24.0), Sense::hover());
    let kind = match &project.origin {
        Origin::Preset(_) => "  (copy of a preset)",
        Origin::Unsaved => "  (not saved)",
        _ => "",
    };
    let mut job = egui::text::LayoutJob::default();
    let format = |size, color| egui::TextFormat::simple(FontId::proportional(size), color);
    job.append(&project.name, 0.0, format(13.5, p.strong));
    job.append(kind, 0.0, format(12.0, p.weak));
    job.wrap = egui::text::TextWrapping::truncate_at_width((rect.width() - 36.0).max(0.0));
    let galley = ui.painter().layout_job(job);
    if rect.width() > 60.0 {
        let at = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), rect);
        ui.painter().galley(at.min, galley, p.text);
        if session.is_dirty() {
            ui.painter().circle_filled(at.left_center() - egui::vec2(9.0, 0.0), 3.5, p.accent);
        }
    }
    let info = &project.info;
    response.on_hover_ui(|ui| {
        ui.label(&project.name);
        match &project.origin {
            Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => {
                ui.colored_label(p.weak, path.display().to_string());
            }
            Origin::Preset(_) => {
                drop(ui.colored_label(p.weak, "Saving asks for a folder; the preset stays unchanged."))
            }
            Origin::Unsaved => drop(ui.colored_label(p.weak, "Saving asks for a folder.")),
        }
        if !info.author.is_empty() {
            ui.colored_label(p.weak, format!("by {}", info.author));
        }
        if !info.description.is_empty() {
            ui.set_max_width(360.0);
            ui.label(&info.description);
        }
    });
}
