//! The overlay that lists the keys.

use super::{
    outbox::Outbox,
    shortcuts::{self, EDITOR_KEYS, SHORTCUTS},
    theme,
};
use egui::{Grid, Id, Modal, ScrollArea, Ui};

/// Shows it; false when it is closed.
pub fn show(ui: &Ui, out: &mut Outbox) -> bool {
    let window = ui.ctx().content_rect();
    let mut open = true;
    let modal = Modal::new(Id::unique("help")).frame(theme::dialog(ui.style())).show(ui.ctx(), |ui| {
        ui.set_width((window.width() - 60.0).min(560.0));
        ui.horizontal(|ui| {
            ui.heading("Keys");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if out.clicked("button:close-help", &ui.button("Close")) {
                    open = false;
                }
            });
        });
        ui.separator();
        let list = ScrollArea::vertical().max_height((window.height() - 150.0).max(80.0));
        list.auto_shrink([false, true]).show(ui, |ui| {
            ui.label(
                "Click the picture to send keys and the mouse to the shader, the code to type. A blue frame \
            shows who has the keyboard.",
            );
            ui.add_space(6.0);
            Grid::new("keys").num_columns(2).spacing([28.0, 5.0]).striped(true).show(ui, |ui| {
                for (i, s) in SHORTCUTS.iter().enumerate().filter(|(_, s)| !s.label.is_empty()) {
                    let also = SHORTCUTS[i + 1..].iter().take_while(|s| s.label.is_empty()).map(shortcuts::name);
                    let keys: Vec<String> = std::iter::once(shortcuts::name(s)).chain(also).collect();
                    ui.colored_label(theme::STRONG, keys.join(",  "));
                    ui.label(s.label);
                    ui.end_row();
                }
                for (keys, what) in EDITOR_KEYS {
                    ui.colored_label(theme::STRONG, *keys);
                    ui.label(*what);
                    ui.end_row();
                }
            });
            ui.add_space(6.0);
            ui.colored_label(
                theme::WEAK,
                "Code compiles a moment after the last key. Files saved by another editor are taken in at once.",
            );
        });
    });
    open && !modal.should_close()
}
