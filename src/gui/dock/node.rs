//! An arrangement as data, and its text format.
//!
//! `"code"` is a panel; `{ row = ["picture", "code"], shares = [0.6, 0.4] }` places panels side by side, `column` one
//! below the other; panels of `{ tabs = ["uniforms", "costs"], front = 0 }` share a place.

use super::Panel;
use crate::gui::panels::DefaultPlace;
use std::collections::BTreeSet;
use toml_edit::{Array, InlineTable, Value};

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Node {
    Panel(Panel),
    /// Children, each with its share of the width.
    Row(Vec<(Node, f32)>),
    /// Children, each with its share of the height.
    Column(Vec<(Node, f32)>),
    /// Children that share a place, and the index of the one in front.
    Tabs(Vec<Node>, usize),
}

fn is_below_picture(panel: Panel) -> bool {
    panel.row().place == DefaultPlace::BelowPicture
}

impl Node {
    pub(crate) fn panels(&self) -> BTreeSet<Panel> {
        match self {
            Node::Panel(panel) => BTreeSet::from([*panel]),
            Node::Row(parts) | Node::Column(parts) => parts.iter().flat_map(|(node, _)| node.panels()).collect(),
            Node::Tabs(nodes, _) => nodes.iter().flat_map(Node::panels).collect(),
        }
    }

    /// Adds a panel to an arrangement: next to those that share its place by default, else below everything.
    pub(super) fn with(node: Option<Node>, panel: Panel) -> Node {
        let Some(mut node) = node else { return Node::Panel(panel) };
        if is_below_picture(panel) && node.join(panel) {
            return node;
        }
        Node::Column(vec![(node, 0.65), (Node::Panel(panel), 0.35)])
    }

    fn join(&mut self, panel: Panel) -> bool {
        match self {
            Node::Panel(there) if is_below_picture(*there) => {
                *self = Node::Tabs(vec![Node::Panel(*there), Node::Panel(panel)], 1);
                true
            }
            Node::Panel(_) => false,
            Node::Tabs(nodes, front) => {
                let fits = nodes.iter().any(|node| matches!(node, Node::Panel(there) if is_below_picture(*there)));
                if fits {
                    *front = nodes.len();
                    nodes.push(Node::Panel(panel));
                }
                fits
            }
            Node::Row(parts) | Node::Column(parts) => parts.iter_mut().any(|(node, _)| node.join(panel)),
        }
    }

    /// Removes a panel from an arrangement; returns `None` if it was the only one.
    pub(super) fn without(self, panel: Panel) -> Option<Node> {
        let parts = |parts: Vec<(Node, f32)>| -> Vec<(Node, f32)> {
            parts.into_iter().filter_map(|(node, share)| Some((node.without(panel)?, share))).collect()
        };
        let one_or = |mut parts: Vec<(Node, f32)>, all: fn(Vec<(Node, f32)>) -> Node| match parts.len() {
            0 => None,
            1 => parts.pop().map(|(node, _)| node),
            _ => Some(all(parts)),
        };
        match self {
            Node::Panel(there) => (there != panel).then_some(Node::Panel(there)),
            Node::Row(list) => one_or(parts(list), Node::Row),
            Node::Column(list) => one_or(parts(list), Node::Column),
            Node::Tabs(nodes, front) => {
                let mut nodes: Vec<Node> = nodes.into_iter().filter_map(|node| node.without(panel)).collect();
                match nodes.len() {
                    0 | 1 => nodes.pop(),
                    n => Some(Node::Tabs(nodes, front.min(n - 1))),
                }
            }
        }
    }

    /// Puts a panel in front of another in its place. Returns false if that one is missing.
    pub(super) fn share(&mut self, place: Panel, panel: Panel) -> bool {
        match self {
            Node::Panel(there) if *there == place => {
                *self = Node::Tabs(vec![Node::Panel(place), Node::Panel(panel)], 1);
                true
            }
            Node::Panel(_) => false,
            Node::Row(parts) | Node::Column(parts) => parts.iter_mut().any(|(node, _)| node.share(place, panel)),
            Node::Tabs(nodes, front) => {
                let is_here = nodes.contains(&Node::Panel(place));
                if is_here {
                    *front = nodes.len();
                    nodes.push(Node::Panel(panel));
                }
                is_here
            }
        }
    }

    pub(crate) fn to_value(&self) -> Value {
        let mut table = InlineTable::new();
        match self {
            Node::Panel(panel) => return panel.name().into(),
            Node::Row(parts) | Node::Column(parts) => {
                let key = if matches!(self, Node::Row(_)) { "row" } else { "column" };
                table.insert(key, Value::Array(parts.iter().map(|(node, _)| node.to_value()).collect::<Array>()));
                let sum: f32 = parts.iter().map(|(_, share)| share).sum();
                let round = |share: f32| (f64::from(share / sum.max(f32::MIN_POSITIVE)) * 1000.0).round() / 1000.0;
                let shares = parts.iter().map(|(_, share)| round(*share)).collect::<Array>();
                table.insert("shares", Value::Array(shares));
            }
            Node::Tabs(nodes, front) => {
                table.insert("tabs", Value::Array(nodes.iter().map(Node::to_value).collect::<Array>()));
                table.insert("front", (*front as i64).into());
            }
        }
        Value::InlineTable(table)
    }

    /// Parses the output of [`Node::to_value`], or returns what is wrong with it.
    pub(crate) fn from_value(value: &Value) -> Result<Node, String> {
        let node = Node::read(value)?;
        let mut count = 0;
        node.count(&mut count);
        if count != node.panels().len() {
            return Err("a panel is listed twice".into());
        }
        Ok(node)
    }

    fn count(&self, count: &mut usize) {
        match self {
            Node::Panel(_) => *count += 1,
            Node::Row(parts) | Node::Column(parts) => parts.iter().for_each(|(node, _)| node.count(count)),
            Node::Tabs(nodes, _) => nodes.iter().for_each(|node| node.count(count)),
        }
    }

    fn read(value: &Value) -> Result<Node, String> {
        if let Some(name) = value.as_str() {
            let names = Panel::names();
            return Panel::named(name)
                .map(Node::Panel)
                .ok_or_else(|| format!("unknown panel \"{name}\"; the panels are {names}"));
        }
        let table = value.as_inline_table().ok_or("expected the name of a panel, a row, a column or tabs")?;
        let nodes = |key: &str| -> Result<Option<Vec<Node>>, String> {
            let Some(list) = table.get(key) else { return Ok(None) };
            let list = list.as_array().ok_or_else(|| format!("{key} must be a list"))?;
            if list.is_empty() {
                return Err(format!("{key} is empty"));
            }
            list.iter().map(Node::read).collect::<Result<_, _>>().map(Some)
        };
        let parts = |nodes: Vec<Node>| {
            let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|n| n as f64));
            let share = |i: usize| table.get("shares").and_then(Value::as_array).and_then(|list| number(list.get(i)?));
            let share = |i| share(i).filter(|share| (0.001..=1000.0).contains(share)).map_or(1.0, |share| share as f32);
            nodes.into_iter().enumerate().map(|(i, node)| (node, share(i))).collect()
        };
        if let Some(row) = nodes("row")? {
            Ok(Node::Row(parts(row)))
        } else if let Some(column) = nodes("column")? {
            Ok(Node::Column(parts(column)))
        } else if let Some(tabs) = nodes("tabs")? {
            let front = table.get("front").and_then(Value::as_integer).and_then(|n| usize::try_from(n).ok());
            let front = front.unwrap_or(0).min(tabs.len() - 1);
            Ok(Node::Tabs(tabs, front))
        } else {
            Err("expected a row, a column or tabs".into())
        }
    }
}
