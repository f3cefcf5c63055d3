//! The separators between panels, which can be dragged.
//!
//! Those of `egui_tiles` take the keyboard focus and have no accessible name.

use super::{Panel, tree::line_of};
use crate::gui::theme;
use egui::{CursorIcon, Id, Rect, Sense, Stroke, Ui};
use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tree};

/// The minimum size of a panel, below which its contents are unusable.
const MIN_WIDTH: f32 = 140.0;
const MIN_HEIGHT: f32 = 60.0;
/// The distance from a separator within which it can be grabbed.
const REACH: f32 = 4.0;

/// Shows the separators over the panels, and applies drags. Returns true if something was moved.
pub(super) fn show(ui: &Ui, tree: &mut Tree<Panel>) -> bool {
    let ids: Vec<TileId> = tree.active_tiles();
    let mut is_moved = false;
    for id in ids {
        let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get(id) else { continue };
        let seen: Vec<(TileId, Rect)> =
            linear.children.iter().filter_map(|child| Some((*child, tree.tiles.rect(*child)?))).collect();
        let dir = linear.dir;
        for pair in seen.windows(2) {
            let [(first, a), (second, b)] = [pair[0], pair[1]];
            let Some(to) = drag(ui, dir, (first, a), (second, b)) else { continue };
            if let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(id) {
                share(linear, (first, length(dir, a)), (second, length(dir, b)), to);
                is_moved = true;
            }
        }
    }
    is_moved
}

/// Resizes a tile at the cost of the next one, or of the previous one if it is the last. Returns true if it changed.
pub(super) fn nudge(tree: &mut Tree<Panel>, tile: TileId, dir: LinearDir, by: f32) -> bool {
    let Some((id, at)) = line_of(&tree.tiles, tile, dir) else { return false };
    let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get(id) else { return false };
    let seen = |child: &&TileId| tree.tiles.is_visible_in_layout(**child) && tree.tiles.rect(**child).is_some();
    let next = linear.children[at + 1..].iter().find(seen);
    let Some(other) = next.or_else(|| linear.children[..at].iter().rev().find(seen)).copied() else { return false };
    let this = linear.children[at];
    let (Some(a), Some(b)) = (tree.tiles.rect(this), tree.tiles.rect(other)) else { return false };
    let (a, b) = (length(dir, a), length(dir, b));
    let to = within(dir, a + by, a + b);
    if let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(id) {
        share(linear, (this, a), (other, b), to);
    }
    true
}

/// Limits the length of the first of two panels so that both stay large enough, given the length of both.
fn within(dir: LinearDir, wanted: f32, both: f32) -> f32 {
    let least = if dir == LinearDir::Horizontal { MIN_WIDTH } else { MIN_HEIGHT }.min(both / 2.0);
    wanted.clamp(least, both - least)
}

fn length(dir: LinearDir, rect: Rect) -> f32 {
    if dir == LinearDir::Horizontal { rect.width() } else { rect.height() }
}

/// Returns the new length of the first of two panels while the separator between them is dragged.
fn drag(ui: &Ui, dir: LinearDir, (first, a): (TileId, Rect), (second, b): (TileId, Rect)) -> Option<f32> {
    let (line, cursor) = match dir {
        LinearDir::Horizontal => {
            (Rect::from_x_y_ranges(a.right()..=b.left(), a.y_range()), CursorIcon::ResizeHorizontal)
        }
        LinearDir::Vertical => (Rect::from_x_y_ranges(a.x_range(), a.bottom()..=b.top()), CursorIcon::ResizeVertical),
    };
    let id = Id::unique(("dock line", first, second));
    let response = ui.interact(line.expand(REACH), id, Sense::DRAG);
    if response.hovered() || response.dragged() {
        ui.ctx().set_cursor_icon(cursor);
        let stroke = Stroke::new(2.0, theme::of(ui).accent);
        match dir {
            LinearDir::Horizontal => ui.painter().vline(line.center().x, line.y_range(), stroke),
            LinearDir::Vertical => ui.painter().hline(line.x_range(), line.center().y, stroke),
        };
    }
    // A click moves nothing.
    let is_moving = response.dragged() && ui.input(|i| i.pointer.is_decidedly_dragging());
    let at = response.interact_pointer_pos().filter(|_| is_moving)?;
    let both = length(dir, a) + length(dir, b);
    let wanted = if dir == LinearDir::Horizontal { at.x - a.left() } else { at.y - a.top() };
    Some(within(dir, wanted, both))
}

/// Sets the length of the first of two panels, and gives the rest to the second.
fn share(linear: &mut Linear, (first, a): (TileId, f32), (second, b): (TileId, f32), to: f32) {
    let sum = linear.shares[first] + linear.shares[second];
    let part = to / (a + b).max(1.0);
    linear.shares.set_share(first, sum * part);
    linear.shares.set_share(second, sum * (1.0 - part));
}
