//! The bar that renames a symbol.

use crate::{
    gui::{
        accessible,
        icons::{self, Icon},
        theme,
        ui_output::UiOutput,
    },
    project::Tab,
    session::{Session, TabFix},
};
use egui::{Key, TextEdit, Ui};

pub(super) struct RenameBar {
    tab: Tab,
    /// The position of the name in bytes.
    at: usize,
    name: String,
    text: String,
    takes_focus: bool,
    /// The reason why it was not renamed.
    wrong: Option<String>,
}

/// The results of a frame of the bar.
pub(super) enum Renamed {
    Nothing,
    Closed,
    To(TabFix),
}

impl RenameBar {
    /// Opens the bar for the name at a place, or returns why it cannot be renamed.
    pub(super) fn new(session: &Session, tab: Tab, at: usize) -> Result<Self, String> {
        let name = session.renamable(&tab, at)?;
        Ok(Self { tab, at, text: name.clone(), name, takes_focus: true, wrong: None })
    }

    pub(super) fn show(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) -> Renamed {
        let mut renamed = Renamed::Nothing;
        ui.horizontal_wrapped(|ui| {
            ui.label(format!("Rename {} to", self.name));
            let field = ui.add(TextEdit::singleline(&mut self.text).desired_width(180.0));
            accessible::name(&field, egui::Role::TextInput, "New name");
            out.place("field:rename", field.rect);
            if std::mem::take(&mut self.takes_focus) {
                field.request_focus();
                let all = egui::text::CCursorRange::two(
                    egui::text::CCursor::new(0),
                    egui::text::CCursor::new(self.text.chars().count()),
                );
                if let Some(mut state) = TextEdit::load_state(ui.ctx(), field.id) {
                    state.cursor.set_char_range(Some(all));
                    state.store(ui.ctx(), field.id);
                }
            }
            if field.changed() {
                self.wrong = None;
            }
            let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            let button = ui.add_enabled(!self.text.trim().is_empty(), egui::Button::new("Rename"));
            if out.clicked("rename:ok", &button) || entered {
                match session.rename(&self.tab, self.at, &self.text) {
                    Ok(fix) => renamed = Renamed::To(fix),
                    Err(why) => {
                        self.wrong = Some(why);
                        field.request_focus();
                    }
                }
            }
            let close = icons::button(ui, Icon::Close, "Close").on_hover_text("Close (Esc)");
            if out.clicked("rename:close", &close) || ui.input(|i| i.key_pressed(Key::Escape)) {
                renamed = Renamed::Closed;
            }
            if let Some(why) = &self.wrong {
                let wrong = ui.colored_label(theme::of(ui).error, why);
                out.place("rename:wrong", wrong.rect);
            }
        });
        renamed
    }
}
