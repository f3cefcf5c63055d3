//! The bar at the top: gallery, new, open, save, the project's name, help.

use super::{
    icons::{self, Icon},
    outbox::{Outbox, Pick, Wish},
    shortcuts::{self, Action},
    theme,
};
use crate::{
    project::Origin,
    session::{Command, Session},
};
use egui::{Align, Align2, Button, FontId, Layout, Sense, Ui};

pub fn show(ui: &mut Ui, session: &Session, gallery: bool, lab: bool, out: &mut Outbox) {
    ui.spacing_mut().item_spacing.x = 4.0;
    ui.horizontal_centered(|ui| {
        let item =
            |ui: &mut Ui, name: &str, label: &str, tip: &str, action: Action, selected: bool, out: &mut Outbox| {
                let response = ui.add(Button::new(label).selected(selected));
                let response = response.on_hover_text(format!("{tip} ({})", shortcuts::hint(action)));
                if out.clicked(name, &response) {
                    out.act(action);
                }
            };
        item(ui, "button:gallery", "Gallery", "Presets to start from", Action::Gallery, gallery, out);
        item(ui, "button:new", "New", "A shader of one Image pass", Action::New, false, out);
        let menu = ui.menu_button("Open", |ui| {
            if ui.button("Folder…").on_hover_text("A folder with eddy.toml or with .glsl files").clicked() {
                out.wishes.push(Wish::Pick(Pick::OpenFolder));
                ui.close();
            }
            let file = Button::new("File…").shortcut_text(shortcuts::hint(Action::Open));
            if ui.add(file).on_hover_text("One .glsl file, or a Shadertoy .json").clicked() {
                out.act(Action::Open);
                ui.close();
            }
        });
        out.place("button:open", menu.response.rect);
        if !gallery {
            item(ui, "button:save", "Save", "Write the project to its files", Action::Save, false, out);
            item(ui, "button:save-as", "Save as", "Write the project into another folder", Action::SaveAs, false, out);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            item(ui, "button:help", "?", "Keys", Action::Help, false, out);
            // Where there is room beside the rest.
            if ui.available_width() > 90.0 {
                item(
                    ui,
                    "button:lab",
                    "Lab",
                    "Measure methods: speed against error",
                    Action::Lab,
                    lab && !gallery,
                    out,
                );
            }
            if !gallery {
                let full = icons::button(ui, Icon::Expand, "Full screen")
                    .on_hover_text(format!("Picture alone, full screen ({})", shortcuts::hint(Action::Fullscreen)));
                if out.clicked("button:fullscreen", &full) {
                    out.act(Action::Fullscreen);
                }
                let compile = ui.button("Compile").on_hover_text(format!(
                    "Compile at once ({}); it happens by itself a moment after the last key",
                    shortcuts::hint(Action::Compile)
                ));
                if out.clicked("button:compile", &compile) {
                    out.ask(Command::CompileNow);
                }
                name(ui, session);
            }
        });
    });
}

/// The project's name in what room is left, with a dot while it is not saved.
fn name(ui: &mut Ui, session: &Session) {
    let project = session.project();
    let (rect, response) = ui.allocate_exact_size(egui::vec2(ui.available_width(), 24.0), Sense::hover());
    let kind = match &project.origin {
        Origin::Preset(_) => "  (a copy of the preset)",
        Origin::Unsaved => "  (not saved yet)",
        _ => "",
    };
    let mut job = egui::text::LayoutJob::default();
    let format = |size, color| egui::TextFormat::simple(FontId::proportional(size), color);
    job.append(&project.name, 0.0, format(13.5, theme::STRONG));
    job.append(kind, 0.0, format(12.0, theme::WEAK));
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width() - 36.0);
    let galley = ui.painter().layout_job(job);
    let at = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), rect);
    ui.painter().galley(at.min, galley, theme::TEXT);
    if session.is_dirty() {
        ui.painter().circle_filled(at.left_center() - egui::vec2(9.0, 0.0), 3.5, theme::ACCENT);
    }
    let info = &project.info;
    response.on_hover_ui(|ui| {
        ui.label(&project.name);
        match &project.origin {
            Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => {
                ui.colored_label(theme::WEAK, path.display().to_string());
            }
            Origin::Preset(_) => {
                drop(ui.colored_label(theme::WEAK, "Saving asks for a folder; the preset itself stays as it is."))
            }
            Origin::Unsaved => drop(ui.colored_label(theme::WEAK, "Saving asks for a folder.")),
        }
        if !info.author.is_empty() {
            ui.colored_label(theme::WEAK, format!("by {}", info.author));
        }
        if !info.description.is_empty() {
            ui.set_max_width(360.0);
            ui.label(&info.description);
        }
    });
}
