//! Moves panels by keys: resizes one, moves it to an edge, or shares its place with another.

use super::{BAR, Dock, Node, Panel, Side, separators, tree};
use egui::{Pos2, Rect};
use egui_tiles::LinearDir;

/// The distance in points by which a key moves a separator.
const STEP: f32 = 24.0;
/// The part of the window that a panel gets at the edge to which it is moved.
const EDGE: f32 = 0.33;

impl Dock {
    /// Returns the panel at a point, including its title row.
    pub(crate) fn panel_at(&self, at: Pos2) -> Option<Panel> {
        let place = |panel: &Panel| self.tree.tiles.rect(panel.tile());
        let is_in = |rect: Rect, panel: &Panel| {
            let row = if panel.has_own_row() { 0.0 } else { BAR };
            rect.with_min_y(rect.top() - row).contains(at)
        };
        self.seen.iter().find(|panel| place(panel).is_some_and(|rect| is_in(rect, panel))).copied()
    }

    /// Resizes a panel. Does nothing if it has the whole width or height.
    pub(crate) fn resize(&mut self, panel: Panel, side: Side) {
        let (dir, by) = match side {
            Side::Left => (LinearDir::Horizontal, -STEP),
            Side::Right => (LinearDir::Horizontal, STEP),
            Side::Up => (LinearDir::Vertical, -STEP),
            Side::Down => (LinearDir::Vertical, STEP),
        };
        self.is_manual |= separators::nudge(&mut self.tree, panel.tile(), dir, by);
    }

    /// Moves a panel to an edge of the window, next to all others.
    pub(crate) fn move_to_edge(&mut self, panel: Panel, side: Side) {
        let Some(rest) = tree::node(&self.tree).and_then(|node| node.without(panel)) else { return };
        let (moved, rest) = ((Node::Panel(panel), EDGE), (rest, 1.0 - EDGE));
        self.arrange(match side {
            Side::Left => Node::Row(vec![moved, rest]),
            Side::Right => Node::Row(vec![rest, moved]),
            Side::Up => Node::Column(vec![moved, rest]),
            Side::Down => Node::Column(vec![rest, moved]),
        });
    }

    /// Puts a panel in front of the next panel, from left to right and from top to bottom, in the same place.
    pub(crate) fn share_place(&mut self, panel: Panel) {
        let place = |panel: &Panel| self.tree.tiles.rect(panel.tile()).map_or((0.0, 0.0), |r| (r.left(), r.top()));
        let mut seen: Vec<Panel> = self.seen.iter().copied().collect();
        seen.sort_by(|a, b| place(a).partial_cmp(&place(b)).unwrap_or(std::cmp::Ordering::Equal));
        let at = seen.iter().position(|other| *other == panel);
        let next = at.and_then(|at| seen.get((at + 1) % seen.len())).filter(|next| **next != panel);
        let rest = tree::node(&self.tree).and_then(|node| node.without(panel));
        let (Some(next), Some(mut rest)) = (next.copied(), rest) else { return };
        rest.share(next, panel);
        self.arrange(rest);
        self.bring_to_front([panel]);
    }

    /// Makes an arrangement the user's own.
    fn arrange(&mut self, node: Node) {
        self.tree = tree::of(&node);
        self.is_manual = true;
        for panel in Panel::all() {
            self.tree.tiles.set_visible(panel.tile(), self.open.contains(&panel));
        }
    }
}
