//! The default layout, computed from the window's aspect ratio and the contents of the panels.

use super::{BAR, Node, Panel};
use crate::gui::panels::DefaultPlace;
use egui::Vec2;
use std::collections::BTreeSet;

/// The preferred heights of panels, without their titles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heights {
    /// The bar below the picture.
    pub transport: f32,
    pub uniforms: f32,
    pub channels: f32,
}

/// The minimum width of the code, if the window is wide enough.
const CODE_WIDTH: f32 = 700.0;
/// The height of the panels below the picture, if it can be chosen.
const BELOW: f32 = 250.0;
/// The height to which channels shrink if others need the room.
const MIN_CHANNELS_HEIGHT: f32 = 44.0;
/// The height to which channels grow if nothing else needs the room.
const MAX_CHANNELS_HEIGHT: f32 = 150.0;
/// The maximum height of a uniforms panel that only shows a hint and no uniforms.
pub(crate) const COLLAPSED: f32 = 44.0;
/// The height of the table of costs.
const COSTS: f32 = 170.0;
/// The part of the height for a panel below the code.
const BELOW_CODE: f32 = 0.42;
/// The part of the height for a panel with pictures or plots below the code.
const BELOW_CODE_LARGE: f32 = 0.56;
/// The lab's part of the height.
const LAB: f32 = 0.48;
/// The minimum width of a plot with its legend. If the code is this wide, the lab is below it and leaves the picture
/// its room; else it is below everything.
const LAB_WIDTH: f32 = 660.0;

/// The open panels, and those in front of others, the newest last.
type Opened<'a> = (&'a BTreeSet<Panel>, &'a [Panel]);

/// Returns the layout of the open panels.
pub(super) fn arrange(size: Vec2, open: &BTreeSet<Panel>, fronts: &[Panel], heights: Heights) -> Node {
    let has_lab = open.contains(&Panel::Lab);
    let aside =
        in_one_place(open.iter().copied().filter(|panel| panel.row().place == DefaultPlace::BelowPicture), fronts);
    let is_tall = |size: Vec2| size.y > size.x * 1.1;
    let above: BTreeSet<Panel> = open.iter().copied().filter(|panel| *panel != Panel::Lab).collect();
    let has_right = code_and_below(&above, fronts).is_some();
    if has_lab && has_right && !is_tall(size) && size.x - least_left(size) >= LAB_WIDTH {
        return two_columns(size, (open, fronts), aside, heights).unwrap_or(Node::Panel(Panel::Lab));
    }
    let is_alone = above.is_empty();
    let upper = Vec2::new(size.x, if has_lab && !is_alone { size.y * (1.0 - LAB) } else { size.y });
    let whole = if is_tall(upper) {
        one_column(upper, (&above, fronts), aside, heights)
    } else {
        two_columns(upper, (&above, fronts), aside, heights)
    };
    match (whole, has_lab) {
        (Some(node), true) => Node::Column(vec![(node, 1.0 - LAB), (Node::Panel(Panel::Lab), LAB)]),
        (Some(node), false) => node,
        (None, _) => Node::Panel(Panel::Lab),
    }
}

/// Lays out the picture with the panels about it on the left, the code on the right.
fn two_columns(size: Vec2, (open, fronts): Opened<'_>, aside: Option<Node>, heights: Heights) -> Option<Node> {
    let right = code_and_below(open, fronts);
    let most = if open.contains(&Panel::Lab) { size.x - LAB_WIDTH } else { size.x };
    let left_width = if right.is_some() { left_width(size, heights).min(most) } else { size.x };
    let left = below_each_other(Vec2::new(left_width, size.y), open, aside, heights);
    match (left, right) {
        (Some(left), Some(right)) => Some(Node::Row(vec![(left, left_width), (right, size.x - left_width)])),
        (None, right @ Some(_)) => right,
        (left, None) => left,
    }
}

/// Puts the panels that show the code's execution below it: a traced pixel, buffers, comparisons, measurements, and
/// the lab if it is wide enough.
fn code_and_below(open: &BTreeSet<Panel>, fronts: &[Panel]) -> Option<Node> {
    let is_open = |panel: &Panel| open.contains(panel);
    let code = is_open(&Panel::Code).then_some(Node::Panel(Panel::Code));
    let is_large = open.iter().any(|panel| *panel == Panel::Lab || panel.row().place == DefaultPlace::BelowCodeLarge);
    let is_below_code =
        |panel: &Panel| matches!(panel.row().place, DefaultPlace::BelowCode | DefaultPlace::BelowCodeLarge);
    let part = if is_large { BELOW_CODE_LARGE } else { BELOW_CODE };
    let shared = Panel::all().filter(is_below_code).chain([Panel::Lab]);
    let below = in_one_place(shared.filter(is_open), fronts);
    match (code, below) {
        (Some(code), Some(below)) => Some(Node::Column(vec![(code, 1.0 - part), (below, part)])),
        (code, below) => code.or(below),
    }
}

/// Puts panels into one place: the one that was opened last, or else the last, is in front.
fn in_one_place(panels: impl Iterator<Item = Panel>, fronts: &[Panel]) -> Option<Node> {
    let nodes: Vec<Node> = panels.map(Node::Panel).collect();
    match nodes.len() {
        0 | 1 => nodes.into_iter().next(),
        n => {
            let place = |panel: &Panel| nodes.iter().position(|node| *node == Node::Panel(*panel));
            let at = fronts.iter().rev().find_map(place).unwrap_or(n - 1);
            Some(Node::Tabs(nodes, at))
        }
    }
}

/// Returns the width at which a 16:9 picture fills the height that the panels below it leave.
fn left_width(size: Vec2, heights: Heights) -> f32 {
    let fitting = (size.y - heights.transport - BELOW) * 16.0 / 9.0;
    fitting.clamp(least_left(size), (size.x * 0.5).max(size.x - CODE_WIDTH))
}

/// Returns the minimum width of the picture.
fn least_left(size: Vec2) -> f32 {
    size.x * if size.x < 1000.0 { 0.5 } else { 0.44 }
}

fn below_each_other(size: Vec2, open: &BTreeSet<Panel>, aside: Option<Node>, heights: Heights) -> Option<Node> {
    let has_picture = open.contains(&Panel::Picture);
    let wants_picture = if has_picture { (size.x * 9.0 / 16.0).ceil() + heights.transport } else { 0.0 };
    let wants_channels = if open.contains(&Panel::Channels) { BAR + heights.channels } else { 0.0 };
    let wants_aside = aside_height(open, heights);
    // The picture has priority over what is below it, which can be scrolled, but leaves a minimum height.
    let least_below = wants_channels + wants_aside.min(BAR + 60.0);
    let picture = wants_picture.min((size.y - least_below).max(size.y * 0.4));
    let below = size.y - picture;
    // Without uniforms the picture gets their room.
    let is_collapsed = heights.uniforms <= COLLAPSED && !open.contains(&Panel::Costs);
    let given = below - wants_aside - wants_channels.max(BAR + MAX_CHANNELS_HEIGHT);
    let given = if has_picture && wants_aside * wants_channels > 0.0 && is_collapsed { given.max(0.0) } else { 0.0 };
    let (picture, below) = (picture + given, below - given);
    let (channels, aside_height) = if wants_aside == 0.0 {
        (below, 0.0)
    } else if wants_channels == 0.0 {
        (0.0, below)
    } else {
        let spare = below - wants_channels - wants_aside;
        let channels = if spare >= 0.0 {
            (wants_channels + spare).min(BAR + MAX_CHANNELS_HEIGHT)
        } else {
            // Cards of one line are sufficient; the panel above must not need scrolling.
            (wants_channels + spare).max(BAR + MIN_CHANNELS_HEIGHT)
        };
        let most = if is_collapsed { below - wants_aside.min(below * 0.4) } else { below * 0.6 };
        (channels.min(most), below - channels.min(most))
    };
    // If nothing is below it, the picture gets everything.
    let picture = if wants_channels + wants_aside == 0.0 { size.y } else { picture };
    let mut parts = Vec::new();
    if has_picture {
        parts.push((Node::Panel(Panel::Picture), picture));
    }
    if let Some(aside) = aside {
        parts.push((aside, aside_height));
    }
    if wants_channels > 0.0 {
        parts.push((Node::Panel(Panel::Channels), channels));
    }
    column(parts)
}

/// Lays out a tall window with the code below the picture, where lines are long enough to read.
fn one_column(size: Vec2, (open, fronts): Opened<'_>, aside: Option<Node>, heights: Heights) -> Option<Node> {
    let mut parts = Vec::new();
    let mut rest = size.y;
    let mut take = |wanted: f32| {
        let taken = wanted.min(rest);
        rest -= taken;
        taken
    };
    if open.contains(&Panel::Picture) {
        let wanted = (size.x * 9.0 / 16.0).ceil() + heights.transport;
        parts.push((Node::Panel(Panel::Picture), take(wanted.min(size.y * 0.45))));
    }
    let channels = open.contains(&Panel::Channels).then(|| take(BAR + heights.channels));
    let aside = aside.map(|node| (node, take(aside_height(open, heights).min(size.y * 0.2))));
    parts.extend(code_and_below(open, fronts).map(|node| (node, rest)));
    parts.extend(aside);
    parts.extend(channels.map(|height| (Node::Panel(Panel::Channels), height)));
    column(parts)
}

fn aside_height(open: &BTreeSet<Panel>, heights: Heights) -> f32 {
    let uniforms = open.contains(&Panel::Uniforms).then_some(BAR + heights.uniforms);
    let costs = open.contains(&Panel::Costs).then_some(BAR + COSTS);
    uniforms.into_iter().chain(costs).fold(0.0, f32::max)
}

fn column(mut parts: Vec<(Node, f32)>) -> Option<Node> {
    match parts.len() {
        0 => None,
        1 => parts.pop().map(|(node, _)| node),
        _ => Some(Node::Column(parts)),
    }
}
