//! Converts an arrangement to the tree that `egui_tiles` shows, and back.

use super::{Node, Panel};
use egui::Id;
use egui_tiles::{Container, Linear, LinearDir, Tabs, Tile, TileId, Tiles, Tree};

impl Panel {
    pub(super) fn tile(self) -> TileId {
        TileId::from_u64(self as u64 + 1)
    }
}

pub(super) fn id() -> Id {
    Id::unique("dock")
}

/// Builds the tree. Tiles have stable ids, so that egui's state of them is kept.
pub(super) fn of(node: &Node) -> Tree<Panel> {
    let mut tiles = Tiles::default();
    let mut next = 100;
    let root = insert(&mut tiles, &mut next, node, true);
    tiles.recompute_next_tile_id();
    Tree::new(id(), root, tiles)
}

/// `needs_tabs`: a single panel gets a group of tabs, which shows its title.
fn insert(tiles: &mut Tiles<Panel>, next: &mut u64, node: &Node, needs_tabs: bool) -> TileId {
    let name = |next: &mut u64| {
        *next += 1;
        TileId::from_u64(*next)
    };
    match node {
        Node::Panel(panel) => {
            tiles.insert(panel.tile(), Tile::Pane(*panel));
            if !needs_tabs {
                return panel.tile();
            }
            let group = TileId::from_u64(50 + panel.tile().0);
            tiles.insert(group, Tile::Container(Container::Tabs(Tabs::new(vec![panel.tile()]))));
            group
        }
        Node::Tabs(nodes, front) => {
            let group = name(next);
            let children: Vec<TileId> = nodes.iter().map(|node| insert(tiles, next, node, false)).collect();
            let mut tabs = Tabs::new(children.clone());
            if let Some(front) = children.get(*front) {
                tabs.set_active(*front);
            }
            tiles.insert(group, Tile::Container(Container::Tabs(tabs)));
            group
        }
        Node::Row(parts) | Node::Column(parts) => {
            let group = name(next);
            let dir = if matches!(node, Node::Row(_)) { LinearDir::Horizontal } else { LinearDir::Vertical };
            let children: Vec<TileId> = parts.iter().map(|(node, _)| insert(tiles, next, node, true)).collect();
            let mut linear = Linear::new(dir, children.clone());
            // A tile that is added later has a share of 1, so shares are scaled to an average of 1.
            let mean = parts.iter().map(|(_, share)| share).sum::<f32>() / parts.len() as f32;
            for (child, (_, share)) in children.into_iter().zip(parts) {
                linear.shares.set_share(child, (share / mean.max(f32::MIN_POSITIVE)).max(1e-3));
            }
            tiles.insert(group, Tile::Container(Container::Linear(linear)));
            group
        }
    }
}

/// Returns the innermost container with several children in a direction around a tile, and the index of the child that
/// contains the tile.
pub(super) fn line_of(tiles: &Tiles<Panel>, tile: TileId, dir: LinearDir) -> Option<(TileId, usize)> {
    let mut at = tile;
    loop {
        let parent = tiles.parent_of(at)?;
        if let Some(Tile::Container(Container::Linear(linear))) = tiles.get(parent)
            && linear.dir == dir
            && linear.children.iter().filter(|child| tiles.is_visible_in_layout(**child)).count() > 1
        {
            return Some((parent, linear.children.iter().position(|child| *child == at)?));
        }
        at = parent;
    }
}

pub(super) fn node(tree: &Tree<Panel>) -> Option<Node> {
    node_of(&tree.tiles, tree.root()?)
}

fn node_of(tiles: &Tiles<Panel>, id: TileId) -> Option<Node> {
    let all = |ids: &[TileId]| ids.iter().filter_map(|id| node_of(tiles, *id)).collect::<Vec<_>>();
    match tiles.get(id)? {
        Tile::Pane(panel) => Some(Node::Panel(*panel)),
        Tile::Container(Container::Tabs(tabs)) => {
            let mut nodes = all(&tabs.children);
            let front = tabs.children.iter().position(|child| Some(*child) == tabs.active).unwrap_or(0);
            match nodes.len() {
                0 => None,
                1 => nodes.pop(),
                n => Some(Node::Tabs(nodes, front.min(n - 1))),
            }
        }
        Tile::Container(Container::Linear(linear)) => {
            let part = |id: &TileId| Some((node_of(tiles, *id)?, linear.shares[*id]));
            let mut parts: Vec<(Node, f32)> = linear.children.iter().filter_map(part).collect();
            match (parts.len(), linear.dir) {
                (0, _) => None,
                (1, _) => parts.pop().map(|(node, _)| node),
                (_, LinearDir::Horizontal) => Some(Node::Row(parts)),
                (_, LinearDir::Vertical) => Some(Node::Column(parts)),
            }
        }
        // Grids are never created.
        Tile::Container(Container::Grid(grid)) => {
            let nodes = all(&grid.children().copied().collect::<Vec<_>>());
            (!nodes.is_empty()).then(|| Node::Column(nodes.into_iter().map(|node| (node, 1.0)).collect()))
        }
    }
}
