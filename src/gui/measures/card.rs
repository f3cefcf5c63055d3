//! A card: the measured expression, its place, and its value over time; or why there is none.

use super::{number::words, plot, state::Axis};
use crate::{
    gui::{
        theme,
        ui_output::{ShellCommand, UiOutput},
    },
    playback::assertion::Unmeasured,
    session::measures::{Measure, Record},
};
use egui::{Align, Frame, Label, Layout, Link, Margin, Rect, RichText, Ui};

/// The maximum number of letters of a comment that are shown.
const LONGEST: usize = 40;

/// The options of a card's display.
pub(super) struct View {
    /// The index from the top of the panel, for scripts.
    pub index: usize,
    pub axis: Axis,
    /// The range of all plots.
    pub range: (f64, f64),
}

/// Returns the place of the card. `trouble`: why nothing is measured.
pub(super) fn show(
    ui: &mut Ui,
    measure: &Measure,
    trouble: Option<&Unmeasured>,
    view: &View,
    out: &mut UiOutput,
) -> Rect {
    let p = theme::of(ui);
    let frame = Frame::NONE.fill(p.raised).corner_radius(5).inner_margin(Margin::symmetric(8, 5));
    let shown = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        head(ui, measure, trouble.is_none(), view.index, out);
        match trouble {
            None => {
                if ui.is_rect_visible(Rect::from_min_size(ui.cursor().min, egui::vec2(1.0, plot::HEIGHT))) {
                    let area = plot::show(ui, measure, view.axis, view.range);
                    out.place(format!("measures:plot:{}", view.index), area);
                } else {
                    ui.add_space(plot::HEIGHT);
                }
            }
            Some(Unmeasured { why, hint }) => {
                let text = RichText::new(format!("Not measured: {why}")).color(p.warning);
                ui.add(Label::new(text).wrap());
                ui.add(Label::new(RichText::new(hint).color(p.weak)).wrap());
            }
        }
    });
    let place = shown.response.rect;
    out.place(format!("measures:card:{}", view.index), place.intersect(ui.clip_rect()));
    place
}

/// Shows the comment, its place, and the newest value.
fn head(ui: &mut Ui, measure: &Measure, is_measured: bool, index: usize, out: &mut UiOutput) {
    let p = theme::of(ui);
    ui.horizontal(|ui| {
        let text = RichText::new(shortened(&measure.text)).monospace().color(p.strong);
        ui.label(text).on_hover_text(&measure.text);
        let place = &measure.place;
        let link = ui.add(Link::new(measure.whereabouts()));
        if out.clicked(&format!("measures:go:{index}"), &link.on_hover_text("Go to comment"))
            && let Some(tab) = &place.tab
        {
            out.shell_commands.push(ShellCommand::GoTo(tab.clone(), Some((place.line - 1, place.column - 1))));
        }
        if !is_measured {
            return;
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let newest = measure.record.newest();
            let (text, color) = match newest {
                Some(newest) if newest.value.is_finite() => (words(newest.value), p.accent),
                Some(newest) => (words(newest.value), p.error),
                None => ("–".to_owned(), p.weak),
            };
            ui.label(RichText::new(text).monospace().size(14.0).color(color));
            ui.add_space(6.0);
            ui.add(Label::new(RichText::new(span(&measure.record)).size(11.5).color(p.weak)).truncate());
        });
    });
}

/// A comment may be of any length, and its place follows it.
fn shortened(text: &str) -> String {
    let mut short: String = text.chars().take(LONGEST).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}

/// Returns the minimum and maximum of the record.
fn span(record: &Record) -> String {
    let bad = record.samples().filter(|sample| !sample.value.is_finite()).count();
    let mut text = match record.extremes() {
        Some((low, high)) => format!("min {}  max {}", words(low), words(high)),
        None => String::new(),
    };
    if bad > 0 {
        text += if text.is_empty() { "not finite" } else { "  and not finite" };
    }
    text
}
