//! The help: a page over the window with the manual and every key, which can be searched and scrolled.

mod text;

use super::{
    actions::{ACTIONS, Action, Entry, Group},
    editor::EditorAction,
    theme,
    ui_output::UiOutput,
};
use egui::{
    Align, FocusDirection, FontId, Grid, Id, Key, Layout, Margin, Modal, Modifiers, RichText, ScrollArea, TextEdit, Ui,
    style::ScrollAnimation, vec2,
};
use text::{Paragraph, SHADERTOY, Section};

/// A readable line width.
const WIDTH: f32 = 700.0;
/// The width of the column of keys.
const KEYS: f32 = 190.0;

/// The actions of the first hour, whose keys come first: those that work where the focus was.
const FIRST: [Action; 12] = [
    Action::TogglePlay,
    Action::Reset,
    Action::Save,
    Action::Palette,
    Action::Code(EditorAction::Propose),
    Action::Code(EditorAction::QuickFix),
    Action::NextProblem,
    Action::Find,
    Action::Present,
    Action::Fullscreen,
    Action::Screenshot,
    Action::NextPanel,
];

/// The page while it is open.
pub(super) struct Help {
    sections: Vec<Section>,
    search: String,
    is_new: bool,
}

impl Help {
    pub(super) fn new() -> Self {
        Self { sections: text::sections(), search: String::new(), is_new: true }
    }

    /// Shows the page; returns false when it is closed.
    pub(super) fn show(&mut self, ui: &Ui, out: &mut UiOutput) -> bool {
        let window = ui.ctx().content_rect();
        let mut is_open = true;
        let height = (window.height() - 150.0).max(80.0);
        let by = scrolled_by_keys(ui, height);
        let modal = Modal::new(Id::unique("help")).frame(theme::dialog(ui.style())).show(ui.ctx(), |ui| {
            ui.set_width((window.width() - 60.0).min(WIDTH));
            // Otherwise egui limits the height to its default for new windows.
            ui.set_max_height(window.height() - 80.0);
            self.header(ui, &mut is_open, out);
            ui.add_space(6.0);
            let list = ScrollArea::vertical().id_salt("help").max_height(height).auto_shrink([false, false]);
            let shown = list.show(ui, |ui| {
                ui.set_max_width(ui.available_width() - 12.0);
                ui.scroll_with_delta_animation(vec2(0.0, -by), ScrollAnimation::none());
                self.contents(ui, out);
            });
            out.place("help:page", shown.inner_rect);
        });
        is_open && !modal.should_close()
    }

    fn header(&mut self, ui: &mut Ui, is_open: &mut bool, out: &mut UiOutput) {
        ui.horizontal(|ui| {
            ui.heading("Help");
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if out.clicked("button:close-help", &ui.button("Close").on_hover_text("Escape")) {
                    *is_open = false;
                }
                let width = ui.available_width().min(260.0);
                let field = TextEdit::singleline(&mut self.search).hint_text("Search").desired_width(width);
                let field = ui.add(field.margin(Margin::symmetric(8, 4)));
                out.place("field:help", field.rect);
                if std::mem::take(&mut self.is_new) {
                    field.request_focus();
                }
            });
        });
        ui.separator();
    }

    fn contents(&self, ui: &mut Ui, out: &mut UiOutput) {
        let wanted = SearchTerms::new(&self.search);
        let mut is_empty = true;
        if self.search.trim().is_empty() {
            title(ui, "Keys of the first hour");
            key_list(ui, "first keys", FIRST.map(|action| (out.keys.hint(action), action.title())).into_iter());
        }
        for section in &self.sections {
            let all = wanted.is_in(&section.title);
            let list: Vec<_> = section.paragraphs.iter().filter(|p| all || wanted.is_in(p.text())).collect();
            if list.is_empty() {
                continue;
            }
            is_empty = false;
            title(ui, &section.title);
            for paragraph in list {
                match paragraph {
                    Paragraph::Code(code) => {
                        ui.indent("code", |ui| ui.label(RichText::new(code).font(FontId::monospace(12.5))));
                    }
                    Paragraph::Text(text) => drop(ui.label(text)),
                }
            }
            if section.title == SHADERTOY {
                let open = ui.button("Open bookmarklet page");
                out.on_click("help:bookmarklet", &open, Action::Bookmarklet);
            }
        }
        for group in Group::ALL {
            let keys = |entry: &Entry| out.keys.key_list(entry);
            let all = wanted.is_in(group.title());
            let is_wanted = |e: &&Entry| {
                let keys = keys(e);
                e.group == group && !keys.is_empty() && (all || wanted.is_in(&format!("{} {keys}", e.title)))
            };
            let list: Vec<_> = ACTIONS.iter().filter(is_wanted).collect();
            if list.is_empty() {
                continue;
            }
            is_empty = false;
            title(ui, &format!("Keys: {}", group.title()));
            key_list(ui, group.title(), list.into_iter().map(|entry| (keys(entry), entry.title)));
        }
        if is_empty {
            ui.add_space(20.0);
            let text = format!("No help found for \"{}\".", self.search.trim());
            ui.vertical_centered(|ui| ui.colored_label(theme::of(ui).weak, text));
        }
        ui.add_space(8.0);
    }
}

/// Shows keys and what they do.
fn key_list<'a>(ui: &mut Ui, id: &str, rows: impl Iterator<Item = (String, &'a str)>) {
    let grid = Grid::new(id).num_columns(2).min_col_width(KEYS).spacing([20.0, 5.0]).striped(true);
    // Titles wrap: a long one would make the page wider than its header.
    grid.max_col_width((ui.available_width() - KEYS - 20.0).max(KEYS)).show(ui, |ui| {
        for (keys, title) in rows {
            ui.label(RichText::new(keys).color(theme::of(ui).strong));
            ui.label(title);
            ui.end_row();
        }
    });
}

/// Returns how far keys scroll the page, in points: all keys except those that type in the search field.
fn scrolled_by_keys(ui: &Ui, height: f32) -> f32 {
    let count = |key| {
        let times = ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key));
        if times > 0 {
            ui.memory_mut(|m| m.move_focus(FocusDirection::None));
        }
        times as f32
    };
    let rows = count(Key::ArrowDown) - count(Key::ArrowUp);
    let pages = count(Key::PageDown) - count(Key::PageUp);
    rows * 40.0 + pages * (height - 40.0)
}

fn title(ui: &mut Ui, text: &str) {
    ui.add_space(12.0);
    ui.label(RichText::new(text).size(15.0).color(theme::of(ui).strong));
    ui.allocate_space(vec2(0.0, 1.0));
}

/// The search words, in lower case.
struct SearchTerms(Vec<String>);

impl SearchTerms {
    fn new(typed: &str) -> Self {
        Self(typed.split_whitespace().map(str::to_lowercase).collect())
    }

    /// Returns whether a text contains all of them; always true for an empty search.
    fn is_in(&self, text: &str) -> bool {
        let text = text.to_lowercase();
        self.0.iter().all(|word| text.contains(word.as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::panels::Panel;

    #[test]
    fn search_matches_all_words_in_any_order_and_case() {
        let text = "iMouse follows the mouse over the picture";
        assert!(SearchTerms::new("").is_in(text) && SearchTerms::new("  imouse PICTURE ").is_in(text));
        assert!(!SearchTerms::new("imouse keys").is_in(text));
        assert!(
            text::sections()
                .iter()
                .any(|s| s.paragraphs.iter().any(|p| SearchTerms::new("iuniform color3").is_in(p.text())))
        );
    }

    #[test]
    fn every_panel_is_in_the_help() {
        let sections = text::sections();
        for panel in Panel::all() {
            let wanted = SearchTerms::new(panel.title());
            let is_there = sections.iter().any(|s| s.paragraphs.iter().any(|p| wanted.is_in(p.text())));
            assert!(is_there, "docs/using.md and docs/debugging.md do not speak of {}", panel.title());
        }
    }

    /// The help uses the default keys of the table.
    #[test]
    fn keys_in_the_help_match_the_table() {
        // The menu key is not in a table: it is the system's (`menus.rs`).
        let keys: Vec<&str> = ACTIONS.iter().flat_map(|e| e.keys).copied().chain(["Shift+F10"]).collect();
        let is_named = |word: &str| word.starts_with('F') && word[1..].parse::<u8>().is_ok() || word.contains("Shift+");
        // The mouse is not in a table.
        let is_key = |word: &str| is_named(word) && !word.ends_with("click") && !word.ends_with("drag");
        let sections = text::sections();
        let texts = sections.iter().flat_map(|s| &s.paragraphs).map(Paragraph::text);
        let keys_in_text = texts.flat_map(|text| text.split([' ', ',', '.', ';', ':', '(', ')']));
        let keys_in_text: Vec<&str> = keys_in_text.filter(|word| is_key(word)).collect();
        assert!(keys_in_text.contains(&"F6"), "{keys_in_text:?}");
        keys_in_text.iter().for_each(|key| assert!(keys.contains(key), "the table has no key {key}"));
    }
}
