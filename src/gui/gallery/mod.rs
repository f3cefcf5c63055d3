//! The start page: a new shader, recent projects, and the presets.
//!
//! Owns the search text and the selected category.

mod card;
mod grid;
mod start;

use super::{
    accessible, theme,
    thumbnails::Thumbnails,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{project::presets, session::Session};
use card::Card;
use egui::{Frame, Margin, RichText, ScrollArea, TextEdit, Ui, pos2, vec2};
use grid::{GAP, columns};
use std::time::Instant;

/// The time that the pointer must rest on a card before its picture moves, in seconds.
const RESTS: f32 = 0.15;

#[derive(Debug, Default)]
pub(super) struct Gallery {
    /// The selected category; `None`: all.
    category: Option<&'static str>,
    search: String,
    /// Show more than one row of recent projects.
    shows_all_recent: bool,
    /// The card below the pointer, and since when.
    hovered: Option<(&'static str, Instant)>,
}

impl Gallery {
    /// `can_close`: a project is open below the gallery.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        thumbnails: &mut Thumbnails,
        can_close: bool,
        out: &mut UiOutput,
    ) {
        out.stop("gallery", ui);
        let p = theme::of(ui);
        let margin = if ui.available_width() > 700.0 { 32 } else { 14 };
        let mut hovered = None;
        ui.painter().rect_filled(ui.max_rect(), 0.0, p.background);
        // The margins scroll too, so that the scroll bar is at the window's edge.
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            Frame::NONE.inner_margin(Margin::symmetric(margin, 0)).show(ui, |ui| {
                ui.add_space(14.0);
                ui.set_width(ui.available_width() - 12.0);
                if can_close {
                    let back = ui.button(format!("Back to {}", short(session)));
                    out.on_click("button:close-gallery", &back, ShellCommand::CloseGallery);
                    ui.add_space(4.0);
                }
                start::show(ui, session, thumbnails, &mut self.shows_all_recent, out);
                ui.add_space(14.0);
                self.filter(ui, out);
                hovered = self.presets(ui, thumbnails, out);
                ui.add_space(20.0);
            });
        });
        self.animate(ui, hovered, thumbnails);
    }

    /// Animates the picture below the pointer.
    fn animate(&mut self, ui: &Ui, hovered: Option<&'static str>, thumbnails: &mut Thumbnails) {
        let now = Instant::now();
        self.hovered = match (self.hovered, hovered) {
            (Some((before, since)), Some(name)) if before == name => Some((name, since)),
            (_, Some(name)) => Some((name, now)),
            (_, None) => None,
        };
        let rested = self.hovered.filter(|(_, since)| now.saturating_duration_since(*since).as_secs_f32() >= RESTS);
        if self.hovered.is_some() && rested.is_none() {
            ui.ctx().request_repaint_after(std::time::Duration::from_secs_f32(RESTS));
        }
        thumbnails.animate(rested.map(|(name, _)| name));
    }

    fn filter(&mut self, ui: &mut Ui, out: &mut UiOutput) {
        let p = theme::of(ui);
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("Presets").size(17.0).color(p.strong));
            ui.add_space(8.0);
            let all = ui.selectable_label(self.category.is_none(), "All");
            if out.clicked("category:all", &all) {
                self.category = None;
            }
            for category in presets::categories() {
                let title = category.title.as_str();
                let item = ui.selectable_label(self.category == Some(title), title);
                if out.clicked(&format!("category:{title}"), &item) {
                    self.category = Some(title);
                }
            }
            ui.add_space(8.0);
            let field = TextEdit::singleline(&mut self.search).hint_text("Search").desired_width(150.0);
            let field = field.background_color(p.button);
            let field = ui.add(field);
            accessible::name(&field, egui::Role::TextInput, "Search presets");
            out.place("gallery:search", field.rect);
        });
        ui.colored_label(p.weak, "Editing a preset edits a copy. Hover over a card to play it.");
    }

    /// Shows the cards. Returns the one below the pointer.
    fn presets(&self, ui: &mut Ui, thumbnails: &mut Thumbnails, out: &mut UiOutput) -> Option<&'static str> {
        let words: Vec<String> = self.search.split_whitespace().map(str::to_lowercase).collect();
        let mut hovered = None;
        let mut is_empty = true;
        for category in presets::categories() {
            if self.category.is_some_and(|one| one != category.title) {
                continue;
            }
            let cards: Vec<&Card> = category.names.iter().filter_map(|name| card::of(name)).collect();
            let cards: Vec<&Card> = cards.into_iter().filter(|c| c.fits(&words)).collect();
            if cards.is_empty() {
                continue;
            }
            is_empty = false;
            ui.add_space(10.0);
            let title = RichText::new(&category.title).size(14.5).color(theme::of(ui).text);
            let heading = ui.label(title);
            out.place(format!("heading:{}", category.title), heading.rect);
            ui.add_space(6.0);
            hovered = grid(ui, &cards, thumbnails, out).or(hovered);
        }
        if is_empty {
            ui.add_space(10.0);
            ui.colored_label(theme::of(ui).weak, format!("No preset matches \"{}\"", self.search.trim()));
        }
        hovered
    }
}

/// Shows cards in rows, each as high as its longest text requires.
fn grid(ui: &mut Ui, cards: &[&'static Card], thumbnails: &mut Thumbnails, out: &mut UiOutput) -> Option<&'static str> {
    let room = ui.available_width();
    let (columns, width) = columns(room);
    let mut hovered = None;
    for row in cards.chunks(columns as usize) {
        let texts: Vec<_> = row.iter().map(|card| card.text(ui, width)).collect();
        let text_height = texts.iter().map(|t| t.size().y).fold(0.0, f32::max);
        let height = card::height(width, text_height);
        let (place, _) = ui.allocate_exact_size(vec2(room, height), egui::Sense::hover());
        for (i, (card, text)) in row.iter().zip(texts).enumerate() {
            let corner = pos2(place.left() + i as f32 * (width + GAP), place.top());
            let rect = egui::Rect::from_min_size(corner, vec2(width, height));
            if card.show(ui, rect, text, thumbnails, out) {
                hovered = Some(card.name);
            }
        }
        ui.add_space(GAP - ui.spacing().item_spacing.y);
    }
    hovered
}

fn short(session: &Session) -> String {
    let name = &session.project().name;
    if name.chars().count() > 24 { format!("{}…", name.chars().take(23).collect::<String>()) } else { name.clone() }
}
