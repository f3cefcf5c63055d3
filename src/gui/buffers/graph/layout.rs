//! The positions of the nodes of a layered graph, and the paths of its edges.

use super::layers::{Edge, Layers};
use egui::{Pos2, Rect, Vec2, pos2, vec2};
use rustc_hash::FxHashSet;

/// The size of a node in points, and the distances between layers and between nodes.
pub(super) const NODE: Vec2 = vec2(164.0, 68.0);
const BETWEEN_LAYERS: f32 = 46.0;
const BETWEEN_NODES: f32 = 26.0;
/// Between a node and an edge that passes it.
const BESIDE: f32 = 10.0;
/// The height of an edge that passes a layer.
const PASSING: f32 = 14.0;
/// Between the paths of edges that go back.
const LANE: f32 = 9.0;
const MARGIN: f32 = 12.0;

/// A graph on a sheet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    pub nodes: Vec<Rect>,
    /// The corners of the path of each forward edge.
    pub forward_paths: Vec<Vec<Pos2>>,
    /// The corners of the path of each other edge.
    pub back_paths: Vec<Vec<Pos2>>,
    pub size: Vec2,
}

impl Layout {
    /// `forward_edges`: acyclic edges; `back_edges`: all others. A long chain is broken into rows, like text, if it would be
    /// illegible when it is fitted into `area`.
    pub(super) fn new(nodes: usize, forward_edges: &[Edge], back_edges: &[Edge], area: Vec2) -> Self {
        let layers = Layers::new(nodes, forward_edges);
        let middles = middles(&layers, nodes);
        let rows = Rows::new(&layers, &middles, (nodes, forward_edges, back_edges), area);
        let at = |node: usize| rows.place(layers.layer_of[node], middles[node]);
        let row_of = |node: usize| rows.row(layers.layer_of[node]);
        // Paths between rows, and back edges, have lanes of their own below the row that they come from.
        let mut lanes = vec![0; rows.tops.len()];
        let mut lane = |row: usize| {
            lanes[row] += 1;
            rows.bottom(row) + 16.0 + LANE * lanes[row] as f32
        };
        let rects: Vec<Rect> = (0..nodes).map(|node| Rect::from_center_size(at(node), NODE)).collect();
        let ports = ports(nodes, forward_edges, back_edges, &middles);
        let round = |n: usize, start: Pos2, end: Pos2, low: f32| {
            let aside = 10.0 + 4.0 * (n % 6) as f32;
            let (right, left) = (start.x + aside, end.x - aside);
            vec![start, pos2(right, start.y), pos2(right, low), pos2(left, low), pos2(left, end.y), end]
        };
        let mut forward_paths = Vec::new();
        for (n, (edge, path)) in forward_edges.iter().zip(&layers.paths).enumerate() {
            let end = pos2(rects[edge.1].left(), rects[edge.1].top() + ports[n]);
            let start = rects[edge.0].right_center();
            if row_of(edge.0) != row_of(edge.1) {
                forward_paths.push(round(n, start, end, lane(row_of(edge.0))));
                continue;
            }
            let mut points = vec![start];
            for node in &path[1..path.len() - 1] {
                let half = vec2(NODE.x / 2.0, 0.0);
                points.extend([at(*node) - half, at(*node) + half]);
            }
            points.push(end);
            forward_paths.push(points);
        }
        let mut back_paths = Vec::new();
        for (n, &(from, to)) in back_edges.iter().enumerate() {
            let (source, reader) = (rects[from], rects[to]);
            let start = pos2(source.right(), source.bottom() - 11.0);
            let end = pos2(reader.left(), reader.top() + ports[forward_edges.len() + n]);
            // A self-edge goes round its own node, the others go below the whole row.
            let low = if from == to { source.bottom() + 9.0 } else { lane(row_of(from)) };
            back_paths.push(round(n, start, end, low));
        }
        let width = left_of(rows.length) - BETWEEN_LAYERS + 34.0 + MARGIN;
        let last = rows.tops.len().saturating_sub(1);
        let most = lanes.get(last).copied().unwrap_or_default();
        let size = vec2(width, rows.bottom(last) + 24.0 + LANE * most as f32 + MARGIN);
        Self { nodes: rects, forward_paths, back_paths, size }
    }
}

/// Below this scale the texts of a node are illegible.
pub(super) const LEGIBLE: f32 = 0.6;
/// The space below a row, in addition to its lanes.
const BELOW: f32 = 18.0;

/// The number of nodes, and the forward and back edges.
type Graph<'a> = (usize, &'a [Edge], &'a [Edge]);

/// The rows that the layers are broken into: each has the same number of layers, and is below the previous one.
struct Rows {
    /// The number of layers in a row.
    length: usize,
    /// The top of each row on the sheet.
    tops: Vec<f32>,
    /// The top and bottom of each row, as if all were one row.
    spans: Vec<(f32, f32)>,
    /// The bottom of all rows, with the lanes.
    end: f32,
}

impl Rows {
    fn new(layers: &Layers, middles: &[f32], graph: Graph<'_>, area: Vec2) -> Rows {
        let count = layers.layers.len().max(1);
        let one = Rows::of_length(layers, middles, graph, count);
        if one.scale(area) >= LEGIBLE {
            return one;
        }
        let broken = (2..=count).map(|rows| Rows::of_length(layers, middles, graph, count.div_ceil(rows)));
        // The fewest rows of equal scale.
        broken.fold(one, |best, rows| if rows.scale(area) > best.scale(area) * 1.001 { rows } else { best })
    }

    fn of_length(
        layers: &Layers,
        middles: &[f32],
        (nodes, forward_edges, back_edges): Graph<'_>,
        length: usize,
    ) -> Rows {
        let length = length.max(1);
        let row_of = |node: usize| layers.layer_of[node] / length;
        let lanes = |row: usize| {
            let forward_edges = forward_edges.iter().filter(|(from, to)| row_of(*from) == row && row_of(*to) != row);
            forward_edges.count() + back_edges.iter().filter(|(from, to)| from != to && row_of(*from) == row).count()
        };
        // An edge between rows uses a lane, and needs no room between the nodes that it would pass.
        let between_rows = forward_edges.iter().zip(&layers.paths).filter(|(edge, _)| row_of(edge.0) != row_of(edge.1));
        let round: FxHashSet<usize> =
            between_rows.flat_map(|(_, path)| path[1..path.len() - 1].iter().copied()).collect();
        let (mut tops, mut spans, mut top) = (Vec::new(), Vec::new(), MARGIN);
        for (n, row) in layers.layers.chunks(length).enumerate() {
            let height = |node: usize| if node < nodes { NODE.y } else { PASSING };
            let all = || {
                row.iter()
                    .flatten()
                    .filter(|node| !round.contains(node))
                    .map(|&node| (middles[node], height(node) / 2.0))
            };
            let first = all().map(|(middle, half)| middle - half).fold(f32::INFINITY, f32::min).min(f32::MAX);
            let last = all().map(|(middle, half)| middle + half).fold(first, f32::max);
            tops.push(top);
            spans.push((first, last));
            top += last - first + BELOW + LANE * lanes(n) as f32;
        }
        Rows { length, tops, spans, end: top }
    }

    fn row(&self, layer: usize) -> usize {
        layer / self.length
    }

    fn place(&self, layer: usize, middle: f32) -> Pos2 {
        let row = self.row(layer);
        pos2(left_of(layer % self.length) + NODE.x / 2.0, middle - self.spans[row].0 + self.tops[row])
    }

    fn bottom(&self, row: usize) -> f32 {
        self.spans.get(row).map_or(MARGIN, |(first, last)| last - first + self.tops[row])
    }

    /// Returns the scale at which the whole layout fits into an area.
    fn scale(&self, area: Vec2) -> f32 {
        (area.x / left_of(self.length)).min(area.y / self.end)
    }
}

/// Returns the left edge of a layer. The first has room before it for edges that lead back to it.
fn left_of(layer: usize) -> f32 {
    MARGIN + 34.0 + layer as f32 * (NODE.x + BETWEEN_LAYERS)
}

/// Returns the end of each edge below the top of its reader: ordered from the top by the place of its start.
fn ports(nodes: usize, forward_edges: &[Edge], back_edges: &[Edge], middles: &[f32]) -> Vec<f32> {
    let mut ports = vec![0.0; forward_edges.len() + back_edges.len()];
    for node in 0..nodes {
        let coming = |edges: &[Edge], first: usize| -> Vec<(f32, usize)> {
            let into = edges.iter().enumerate().filter(|(_, edge)| edge.1 == node);
            into.map(|(n, edge)| (middles[edge.0], first + n)).collect()
        };
        let mut incoming = coming(forward_edges, 0);
        incoming.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Edges from below end lowest.
        incoming.extend(coming(back_edges, forward_edges.len()));
        let count = incoming.len() as f32;
        for (n, (_, edge)) in incoming.into_iter().enumerate() {
            ports[edge] = NODE.y * (n as f32 + 1.0) / (count + 1.0);
        }
    }
    ports
}

/// Returns the vertical middle of each node: near its neighbours, and apart from the other nodes of its layer.
fn middles(layers: &Layers, nodes: usize) -> Vec<f32> {
    let height = |node: usize| if node < nodes { NODE.y } else { PASSING };
    let apart = |a: usize, b: usize| {
        let gap = match (a < nodes, b < nodes) {
            (true, true) => BETWEEN_NODES,
            (false, false) => 0.0,
            _ => BESIDE,
        };
        (height(a) + height(b)) / 2.0 + gap
    };
    let mut middles = vec![0.0; layers.layer_of.len()];
    for layer in &layers.layers {
        let mut y = 0.0;
        for (place, &node) in layer.iter().enumerate() {
            y += if place > 0 { apart(layer[place - 1], node) } else { 0.0 };
            middles[node] = y;
        }
        layer.iter().for_each(|node| middles[*node] -= y / 2.0);
    }
    let steps = layers.steps();
    for _ in 0..8 {
        for layer in &layers.layers {
            let wanted: Vec<f32> = layer
                .iter()
                .map(|&node| {
                    let other = |&(from, to): &Edge| match (from == node, to == node) {
                        (true, false) => Some(to),
                        (false, true) => Some(from),
                        _ => None,
                    };
                    let near: Vec<f32> = steps.iter().filter_map(other).map(|other| middles[other]).collect();
                    if near.is_empty() { middles[node] } else { near.iter().sum::<f32>() / near.len() as f32 }
                })
                .collect();
            // Nodes are pushed down in order from the top, and up from the bottom: the mean of both keeps the order
            // and the distances.
            let mut down = wanted.clone();
            let mut up = wanted;
            for place in 1..layer.len() {
                down[place] = down[place].max(down[place - 1] + apart(layer[place - 1], layer[place]));
                let index = layer.len() - 1 - place;
                up[index] = up[index].min(up[index + 1] - apart(layer[index], layer[index + 1]));
            }
            for (place, &node) in layer.iter().enumerate() {
                middles[node] = (down[place] + up[place]) / 2.0;
            }
        }
    }
    let top = (0..middles.len()).map(|node| middles[node] - height(node) / 2.0).fold(f32::INFINITY, f32::min);
    middles.iter_mut().for_each(|middle| *middle += MARGIN - top);
    middles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fluid() -> (usize, Vec<Edge>, Vec<Edge>) {
        // Four passes in a chain, two next to it, the picture that reads all; three read the previous frame.
        let forward_edges = vec![(0, 1), (1, 2), (2, 3), (0, 3), (4, 6), (5, 6), (3, 6), (0, 6)];
        (7, forward_edges, vec![(3, 0), (4, 4), (5, 5)])
    }

    #[test]
    fn nodes_do_not_overlap_and_edges_lead_to_the_right() {
        let (nodes, forward_edges, back_edges) = fluid();
        let layout = Layout::new(nodes, &forward_edges, &back_edges, vec2(4000.0, 3000.0));
        let sheet = Rect::from_min_size(Pos2::ZERO, layout.size);
        for (i, a) in layout.nodes.iter().enumerate() {
            assert!(sheet.contains_rect(*a), "{a:?} of {sheet:?}");
            assert!(layout.nodes[i + 1..].iter().all(|b| !a.expand(8.0).intersects(*b)), "{:?}", layout.nodes);
        }
        for (edge, path) in forward_edges.iter().zip(&layout.forward_paths) {
            assert!(path.windows(2).all(|step| step[1].x >= step[0].x), "{path:?}");
            assert!(layout.nodes[edge.1].distance_to_pos(*path.last().unwrap()) < 0.1);
        }
    }

    #[test]
    fn twenty_passes_fit_legibly() {
        let area = vec2(640.0, 340.0);
        let forward_edges: Vec<Edge> = (1..20).map(|n| (n - 1, n)).chain([(2, 19)]).collect();
        let back_edges = [(19, 0), (5, 5)];
        let layout = Layout::new(20, &forward_edges, &back_edges, area);
        let scale = (area.x / layout.size.x).min(area.y / layout.size.y);
        assert!(scale >= LEGIBLE, "{scale} of {:?}", layout.size);
        crosses_no_node(&layout);
        let sheet = Rect::from_min_size(Pos2::ZERO, layout.size);
        assert!(layout.nodes.iter().all(|node| sheet.contains_rect(*node)));
        let chain = Layout::new(4, &forward_edges[..3], &[], area);
        assert!(chain.nodes.windows(2).all(|pair| pair[0].top() == pair[1].top()), "what can be read is one row");
    }

    #[test]
    fn back_edges_cross_no_node() {
        let (nodes, forward_edges, back_edges) = fluid();
        crosses_no_node(&Layout::new(nodes, &forward_edges, &back_edges, vec2(4000.0, 3000.0)));
        // In rows, too.
        crosses_no_node(&Layout::new(nodes, &forward_edges, &back_edges, vec2(500.0, 600.0)));
    }

    fn crosses_no_node(layout: &Layout) {
        for path in layout.back_paths.iter().chain(&layout.forward_paths) {
            for step in path.windows(2) {
                let segment = Rect::from_two_pos(step[0], step[1]).expand(-0.5).expand(0.4);
                let is_straight = step[0].x == step[1].x || step[0].y == step[1].y;
                let hit = layout.nodes.iter().find(|node| is_straight && node.shrink(1.0).intersects(segment));
                assert!(hit.is_none(), "{step:?} through {hit:?}");
            }
        }
        let sheet = Rect::from_min_size(Pos2::ZERO, layout.size);
        assert!(layout.back_paths.iter().flatten().all(|point| sheet.contains(*point)));
    }
}
