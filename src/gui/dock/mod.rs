//! The layout of the window's panels: their places, sizes, and which are open.
//!
//! Owns the arrangement, the rows with the panels' titles, and dragging. Until the user moves or resizes something,
//! the arrangement follows the window's aspect ratio and the contents of the panels. The shell fills the panels.

mod automatic;
mod bars;
mod by_keys;
mod node;
mod separators;
mod tree;

pub(super) use automatic::{COLLAPSED, Heights};
pub(super) use bars::Contents;
pub(super) use node::Node;

use super::panels::Panel;
use bars::Bars;
use egui::Ui;
use egui_tiles::{Container, Tile, Tree};
use std::collections::BTreeSet;

/// The height of a panel's title row.
const BAR: f32 = 27.0;

/// A direction in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
    Up,
    Down,
}

/// The arrangement of panels.
pub(super) struct Dock {
    tree: Tree<Panel>,
    /// The user has moved or resized a panel; otherwise the arrangement is computed for each frame.
    is_manual: bool,
    open: BTreeSet<Panel>,
    /// The panels in front of those that share their place, the newest last.
    fronts: Vec<Panel>,
    /// Panels that were visible in the newest frame.
    seen: BTreeSet<Panel>,
}

impl Dock {
    pub(super) fn new() -> Self {
        let open = Panel::all().filter(|panel| panel.row().is_open).collect();
        Self { tree: Tree::empty(tree::id()), is_manual: false, open, fronts: Vec::new(), seen: BTreeSet::new() }
    }

    /// Restores the state saved by the last run. `arrangement`: set if it was the user's own.
    pub(super) fn restore(&mut self, open: Option<BTreeSet<Panel>>, arrangement: Option<&Node>) {
        if let Some(open) = open.filter(|open| !open.is_empty()) {
            self.open = open;
        }
        if let Some(node) = arrangement {
            self.tree = tree::of(node);
            self.is_manual = true;
            self.follow_open();
        }
    }

    pub(super) fn open_panels(&self) -> &BTreeSet<Panel> {
        &self.open
    }

    /// Returns the arrangement, if it is the user's own.
    pub(super) fn arrangement(&self) -> Option<Node> {
        self.is_manual.then(|| tree::node(&self.tree)).flatten()
    }

    pub(super) fn is_open(&self, panel: Panel) -> bool {
        self.open.contains(&panel)
    }

    /// Returns whether a panel is visible: open, and not hidden by another tab.
    pub(super) fn is_seen(&self, panel: Panel) -> bool {
        self.seen.contains(&panel)
    }

    /// Opens a panel in front of those that share its place, or closes it. The last one stays open.
    pub(super) fn set_open(&mut self, panel: Panel, is_open: bool) {
        if is_open {
            self.open.insert(panel);
            self.bring_to_front([panel]);
        } else if self.open.len() > 1 {
            self.open.remove(&panel);
        }
        if self.is_manual {
            self.follow_open();
        }
    }

    /// Restores the default arrangement.
    pub(super) fn reset(&mut self) {
        *self = Self { seen: std::mem::take(&mut self.seen), ..Self::new() };
    }

    /// Updates the user's arrangement to contain exactly the open panels.
    fn follow_open(&mut self) {
        let is_missing = |panel: &&Panel| self.tree.tiles.get(panel.tile()).is_none();
        let missing: Vec<Panel> = self.open.iter().filter(is_missing).copied().collect();
        if !missing.is_empty() {
            let whole = missing.into_iter().fold(tree::node(&self.tree), |node, panel| Some(Node::with(node, panel)));
            self.tree = whole.map_or_else(|| Tree::empty(tree::id()), |node| tree::of(&node));
        }
        for panel in Panel::all() {
            self.tree.tiles.set_visible(panel.tile(), self.open.contains(&panel));
        }
        if let Some(front) = self.fronts.last() {
            self.tree.make_active(|id, _| id == front.tile());
        }
    }

    /// Fills the available space.
    pub(super) fn show(&mut self, ui: &mut Ui, contents: &mut dyn Contents) {
        let area = ui.available_rect_before_wrap();
        if !self.is_manual {
            let node = automatic::arrange(area.size(), &self.open, &self.fronts, contents.heights());
            self.tree = tree::of(&node);
        }
        let mut bars = Bars::new(contents, &self.tree);
        self.tree.ui(&mut bars, ui);
        let (edited, closed) = (bars.is_edited, bars.closed);
        let edited = edited | separators::show(ui, &mut self.tree);
        if !self.is_manual {
            // Switching tabs does not make the arrangement the user's own.
            self.bring_to_front(self.front_tabs());
        }
        self.is_manual |= edited;
        if let Some(panel) = closed {
            self.set_open(panel, false);
            ui.ctx().request_repaint();
        }
        self.seen =
            self.tree.active_tiles().into_iter().filter_map(|id| self.tree.tiles.get_pane(&id).copied()).collect();
        self.seen.retain(|panel| self.open.contains(panel));
    }

    fn bring_to_front(&mut self, panels: impl IntoIterator<Item = Panel>) {
        for panel in panels {
            self.fronts.retain(|other| *other != panel);
            self.fronts.push(panel);
        }
    }

    /// Returns the panels in front of those that share their place.
    fn front_tabs(&self) -> Vec<Panel> {
        let front = |tile: &Tile<Panel>| match tile {
            Tile::Container(Container::Tabs(tabs)) if tabs.children.len() > 1 => {
                self.tree.tiles.get_pane(&tabs.active?).copied()
            }
            _ => None,
        };
        self.tree.tiles.tiles().filter_map(front).collect()
    }
}

#[cfg(test)]
mod tests;
