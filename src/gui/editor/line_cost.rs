//! The cost of lines: a bar and a number in the gutter, words beside loops, and dimmed lines that no pixel reaches.

use super::gutter::BESIDE;
use crate::gui::{cost_map, theme};
use egui::{Align2, FontId, Painter, Pos2, Rect, Ui, pos2, vec2};

/// The cost of a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LineCost {
    /// Counted from 0.
    pub line: usize,
    /// Its part of the time of the pass, from 0 to 1.
    pub share: f32,
    /// Some pixel runs it.
    pub is_reached: bool,
    /// The iterations of the loops that start in it.
    pub iterations: Option<String>,
}

/// The width of the column.
const WIDTH: f32 = 62.0;

/// The share from which a line has a number.
const LEAST: f32 = 0.0005;

/// Returns the width of the gutter without its digits.
pub(super) fn beside(costs: &[LineCost]) -> f32 {
    BESIDE + column(costs)
}

/// Returns the width of the column of costs: 0 without any.
pub(super) fn column(costs: &[LineCost]) -> f32 {
    if costs.is_empty() { 0.0 } else { WIDTH }
}

pub(super) fn of(costs: &[LineCost], line: usize) -> Option<&LineCost> {
    costs.binary_search_by_key(&line, |cost| cost.line).ok().map(|index| &costs[index])
}

/// Paints the share of a line into the column: `left` is its left edge.
pub(super) fn paint(painter: &Painter, ui: &Ui, costs: &[LineCost], line: usize, left: Pos2, height: f32) {
    let Some(cost) = of(costs, line).filter(|cost| cost.is_reached && cost.share >= LEAST) else { return };
    let most = costs.iter().map(|cost| cost.share).fold(0.0, f32::max);
    let part = (cost.share / most.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    let bar = Rect::from_min_size(left + vec2(2.0, -height * 0.4), vec2(((WIDTH - 4.0) * part).max(1.5), height * 0.8));
    painter.rect_filled(bar, 2.0, cost_map::color(0.25 + 0.75 * part).gamma_multiply(0.55));
    let percent = 100.0 * cost.share;
    let words = if percent < 9.95 { format!("{percent:.1} %") } else { format!("{percent:.0} %") };
    let font = FontId::monospace((height * 0.55).clamp(7.0, 11.0));
    painter.text(pos2(left.x + WIDTH - 5.0, left.y), Align2::RIGHT_CENTER, words, font, theme::of(ui).strong);
}
