//! The completion list at the caret.

use super::{super::buffer::Buffer, draw};
use crate::{
    glsl::services::{Completion, Completions},
    gui::{accessible, theme},
};
use egui::{Align2, Area, FontId, Frame, Id, Margin, Order, Rect, Sense, Ui, pos2, vec2};
use std::ops::Range;

/// The number of visible rows.
pub(super) const ROWS: usize = 8;
const WIDTH: f32 = 390.0;

#[derive(Debug)]
pub(super) struct Popup {
    list: Completions,
    /// Indices of the matching items, best first; never empty.
    fitting: Vec<usize>,
    selected: usize,
    /// The first visible row.
    top: usize,
    /// The selection was moved, or the list was requested explicitly: Enter accepts.
    is_meant: bool,
}

impl Popup {
    /// Returns `None` if nothing matches. Unless requested explicitly, also if the only match is already in the text.
    pub(super) fn open(list: Completions, buffer: &Buffer, asked_for: bool) -> Option<Self> {
        let mut popup = Self { list, fitting: Vec::new(), selected: 0, top: 0, is_meant: asked_for };
        let opens = popup.filter(buffer) && (asked_for || !popup.is_complete(buffer));
        opens.then_some(popup)
    }

    /// Returns the start of the word that a completion replaces.
    pub(super) fn start(&self) -> usize {
        self.list.replace.start
    }

    fn typed<'b>(&self, buffer: &'b Buffer) -> &'b str {
        buffer.text().get(self.start()..buffer.selection().head).unwrap_or("\n")
    }

    /// Keeps the items that match the current word; returns false if none is left or the caret has left the word.
    pub(super) fn filter(&mut self, buffer: &Buffer) -> bool {
        let typed = self.typed(buffer);
        let is_word = typed.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        // If all the typed text is deleted again, there is nothing left to complete.
        let has_begun = !typed.is_empty() || self.list.is_member || self.is_meant;
        self.fitting = if is_word && has_begun { self.list.matching(typed) } else { Vec::new() };
        (self.selected, self.top) = (0, 0);
        !self.fitting.is_empty()
    }

    /// Returns whether the word is the only match.
    fn is_complete(&self, buffer: &Buffer) -> bool {
        self.fitting.len() == 1 && self.item(0).is_some_and(|item| item.label == self.typed(buffer))
    }

    fn item(&self, row: usize) -> Option<&Completion> {
        self.fitting.get(row).map(|&i| &self.list.items[i])
    }

    pub(super) fn step(&mut self, by: isize) {
        let last = self.fitting.len() as isize - 1;
        let to = self.selected as isize + by;
        // A single step wraps round at the ends, a page stops there.
        let to = if by.abs() == 1 { to.rem_euclid(last + 1) } else { to.clamp(0, last) };
        self.selected = to as usize;
        self.top = self.top.clamp(self.selected.saturating_sub(ROWS - 1), self.selected);
        self.is_meant = true;
    }

    /// Returns whether Enter accepts an item instead of inserting a new line: the item must change the text, and must
    /// continue what was typed unless it was picked explicitly.
    pub(super) fn enter_accepts(&self, buffer: &Buffer) -> bool {
        let typed = self.typed(buffer);
        self.item(self.selected).is_some_and(|item| {
            let goes_on = item.label.get(..typed.len()).is_some_and(|head| head.eq_ignore_ascii_case(typed));
            item.label != typed && (self.is_meant || (goes_on && !typed.is_empty()))
        })
    }

    /// Returns the selected item and the range that it replaces.
    pub(super) fn choice(&self, buffer: &Buffer) -> Option<(Range<usize>, &Completion)> {
        Some((self.start()..buffer.selection().head, self.item(self.selected)?))
    }

    /// Shows the list below `at`, the start of the word, or above it if there is no room. Returns true if a row was
    /// clicked.
    pub(super) fn show(&mut self, ui: &Ui, at: Rect, font: &FontId, placed: &mut Vec<(String, Rect)>) -> bool {
        let window = ui.ctx().content_rect();
        let row = (font.size * 1.55).round();
        let rows = self.fitting.len().min(ROWS);
        let doc = self.item(self.selected).map(|item| item.doc.clone()).filter(|doc| !doc.is_empty());
        let height = rows as f32 * row + if doc.is_some() { 64.0 } else { 12.0 };
        let below = at.bottom() + height < window.bottom() || at.top() - window.top() < height;
        let (pos, pivot) = if below {
            (pos2(at.left() - 30.0, at.bottom() + 3.0), Align2::LEFT_TOP)
        } else {
            (pos2(at.left() - 30.0, at.top() - 3.0), Align2::LEFT_BOTTOM)
        };
        let width = WIDTH.min(window.width() - 16.0);
        let mut clicked = false;
        let area = Area::new(Id::unique("completions"))
            .order(Order::Foreground)
            .fixed_pos(pos)
            .pivot(pivot)
            .constrain_to(window)
            .show(ui.ctx(), |ui| {
                Frame::popup(ui.style()).inner_margin(Margin::same(4)).show(ui, |ui| {
                    ui.set_width(width);
                    ui.spacing_mut().item_spacing.y = 0.0;
                    let first = self.top;
                    for i in first..(first + ROWS).min(self.fitting.len()) {
                        let (rect, response) = ui.allocate_exact_size(vec2(width, row), Sense::click());
                        if let Some(item) = self.item(i) {
                            let is_selected = i == self.selected;
                            accessible::choice(&response, egui::Role::ListBoxOption, is_selected, &item.label);
                        }
                        if response.hovered() && i != self.selected {
                            ui.painter().rect_filled(rect, 4.0, theme::of(ui).button);
                        }
                        if i == self.selected {
                            ui.painter().rect_filled(rect, 4.0, theme::of(ui).accent_fill);
                        }
                        if let Some(item) = self.item(i) {
                            paint_row(ui, rect, item, font, i == self.selected);
                            if !ui.is_sizing_pass() {
                                placed.push((format!("completion:{}", item.label), rect));
                            }
                        }
                        if response.clicked() {
                            self.selected = i;
                            clicked = true;
                        }
                    }
                    if self.fitting.len() > ROWS {
                        self.scroll_bar(ui, row, width);
                    }
                    let scrolled = ui.input(|i| i.smooth_scroll_delta().y);
                    if ui.ui_contains_pointer() && scrolled != 0.0 {
                        let last = self.fitting.len().saturating_sub(ROWS);
                        self.top = self.top.saturating_add_signed(if scrolled < 0.0 { 1 } else { -1 }).min(last);
                    }
                    if let Some(doc) = doc {
                        ui.add_space(4.0);
                        let line = ui.max_rect().x_range();
                        ui.painter().hline(line, ui.cursor().top(), egui::Stroke::new(1.0, theme::of(ui).line));
                        ui.add_space(5.0);
                        let label = egui::RichText::new(doc).size((font.size - 0.5).max(9.0)).color(theme::of(ui).text);
                        ui.add(egui::Label::new(label).wrap());
                        ui.add_space(2.0);
                    }
                });
            });
        placed.push(("completions".into(), area.response.rect));
        clicked
    }

    fn scroll_bar(&self, ui: &Ui, row: f32, width: f32) {
        let whole = ui.min_rect();
        let height = ROWS as f32 * row;
        let part = ROWS as f32 / self.fitting.len() as f32;
        let top = whole.top() + height * self.top as f32 / self.fitting.len() as f32;
        let left = whole.left() + width - 3.0;
        let bar = Rect::from_min_size(pos2(left, top), vec2(3.0, (height * part).max(12.0)));
        ui.painter().rect_filled(bar, 1.5, theme::of(ui).weak.gamma_multiply(0.5));
    }
}

/// Paints a sign for the kind, the name, and its type or signature as far as there is room.
fn paint_row(ui: &Ui, rect: Rect, item: &Completion, font: &FontId, is_selected: bool) {
    let painter = ui.painter().with_clip_rect(rect);
    let (sign, color) = draw::sign(item.kind, theme::of(ui));
    let badge = Rect::from_center_size(pos2(rect.left() + 14.0, rect.center().y), vec2(17.0, 15.0));
    painter.rect_filled(badge, 3.0, color.gamma_multiply(0.22));
    painter.text(badge.center(), Align2::CENTER_CENTER, sign, FontId::monospace(font.size - 2.5), color);
    let name = painter.text(
        pos2(rect.left() + 30.0, rect.center().y),
        Align2::LEFT_CENTER,
        &item.label,
        font.clone(),
        if is_selected { theme::of(ui).strong } else { theme::of(ui).text },
    );
    let room = rect.right() - 10.0 - name.right() - 14.0;
    if room > 30.0 && !item.detail.is_empty() {
        let weak = if is_selected { theme::of(ui).text } else { theme::of(ui).weak };
        let font = FontId::monospace((font.size - 1.5).max(8.0));
        let mut job = egui::text::LayoutJob::simple_singleline(item.detail.clone(), font, weak);
        job.wrap = egui::text::TextWrapping::truncate_at_width(room);
        let galley = painter.layout_job(job);
        let x = rect.right() - 10.0 - galley.size().x;
        painter.galley(pos2(x, rect.center().y - galley.size().y / 2.0), galley, weak);
    }
}
