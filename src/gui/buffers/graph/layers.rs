//! Layered drawing of graphs by Sugiyama, Tagawa and Toda ("Methods for Visual Understanding of Hierarchical System
//! Structures", 1981): each node is after what it reads, long edges pass through a dummy node in each layer between,
//! and the order within layers is improved by barycentres until the number of crossings no longer falls.

use std::collections::BTreeMap;

/// An edge from one node to another, by their indices.
pub(super) type Edge = (usize, usize);

/// The number of sweeps over all layers, forth and back.
const SWEEPS: usize = 12;

/// Nodes in layers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layers {
    /// The layer of each node: first the given nodes, then the dummy nodes of long edges.
    pub layer_of: Vec<usize>,
    /// The nodes of each layer from the top.
    pub layers: Vec<Vec<usize>>,
    /// The path of each given edge, with one node per layer.
    pub paths: Vec<Vec<usize>>,
}

impl Layers {
    /// Takes nodes and acyclic edges; an edge that would form a cycle is ignored in the layering.
    pub(super) fn new(nodes: usize, edges: &[Edge]) -> Self {
        let mut layer_of = longest_paths(nodes, edges);
        let mut paths = Vec::with_capacity(edges.len());
        // Edges from one node share a path as far as possible, and branch off to each reader.
        let mut passing: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for &(from, to) in edges {
            let mut path = vec![from];
            for layer in layer_of[from] + 1..layer_of[to] {
                let node = *passing.entry((from, layer)).or_insert(layer_of.len());
                if node == layer_of.len() {
                    layer_of.push(layer);
                }
                path.push(node);
            }
            path.push(to);
            paths.push(path);
        }
        let count = layer_of.iter().max().map_or(0, |most| most + 1);
        let mut layers = vec![Vec::new(); count];
        layer_of.iter().enumerate().for_each(|(node, layer)| layers[*layer].push(node));
        let mut made = Self { layer_of, layers, paths };
        made.reduce_crossings();
        made
    }

    /// Returns the edges between neighbouring layers, each once.
    pub(super) fn steps(&self) -> Vec<Edge> {
        let mut steps: Vec<Edge> =
            self.paths.iter().flat_map(|path| path.windows(2).map(|step| (step[0], step[1]))).collect();
        steps.sort_unstable();
        steps.dedup();
        steps
    }

    /// Orders the nodes of each layer by the positions of their neighbours in the previous layer, forth and back.
    fn reduce_crossings(&mut self) {
        let (mut best, mut least) = (self.layers.clone(), self.crossings());
        let steps = self.steps();
        for sweep in 0..SWEEPS {
            let is_forward = sweep % 2 == 0;
            let count = self.layers.len();
            for step in 1..count {
                let layer = if is_forward { step } else { count - 1 - step };
                let place = self.places();
                let mut keyed: Vec<(f32, usize)> = Vec::new();
                for &node in &self.layers[layer] {
                    let other = |&(from, to): &Edge| match is_forward {
                        true if to == node && from != node => Some(from),
                        false if from == node && to != node => Some(to),
                        _ => None,
                    };
                    let near: Vec<f32> = steps.iter().filter_map(other).map(|other| place[other] as f32).collect();
                    let own = place[node] as f32;
                    let mean = if near.is_empty() { own } else { near.iter().sum::<f32>() / near.len() as f32 };
                    keyed.push((mean, node));
                }
                // The sort is stable for equal barycentres.
                keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
                self.layers[layer] = keyed.into_iter().map(|(_, node)| node).collect();
            }
            let crossings = self.crossings();
            if crossings < least {
                (best, least) = (self.layers.clone(), crossings);
            }
        }
        self.layers = best;
    }

    /// Returns the position of each node in its layer.
    fn places(&self) -> Vec<usize> {
        let mut places = vec![0; self.layer_of.len()];
        for layer in &self.layers {
            layer.iter().enumerate().for_each(|(place, node)| places[*node] = place);
        }
        places
    }

    /// Returns the number of pairs of edges that cross.
    pub(super) fn crossings(&self) -> usize {
        let place = self.places();
        let steps = self.steps();
        let cross = |a: &Edge, b: &Edge| {
            let is_beside = self.layer_of[a.0] == self.layer_of[b.0];
            is_beside && (place[a.0] < place[b.0]) != (place[a.1] < place[b.1]) && a.0 != b.0 && a.1 != b.1
        };
        (0..steps.len()).map(|i| steps[i + 1..].iter().filter(|b| cross(&steps[i], b)).count()).sum()
    }
}

/// Returns the layer of each node: after the last of its predecessors.
fn longest_paths(nodes: usize, edges: &[Edge]) -> Vec<usize> {
    let mut layer = vec![0; nodes];
    // The longest path bounds the number of rounds, which also ends cycles.
    for _ in 0..nodes {
        let mut is_settled = true;
        for &(from, to) in edges.iter().filter(|(from, to)| from != to) {
            if layer[to] <= layer[from] && layer[from] + 1 < nodes {
                layer[to] = layer[from] + 1;
                is_settled = false;
            }
        }
        if is_settled {
            break;
        }
    }
    layer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_follow_what_they_read_and_long_edges_pass_each_layer() {
        let layers = Layers::new(4, &[(0, 1), (1, 2), (0, 2), (3, 2)]);
        assert_eq!(&layers.layer_of[..4], [0, 1, 2, 0]);
        assert_eq!(layers.paths[2].len(), 3, "from 0 to 2 past 1");
        assert!(layers.steps().into_iter().all(|(from, to)| layers.layer_of[to] > layers.layer_of[from]));
        assert_eq!(layers.layers.iter().map(Vec::len).sum::<usize>(), layers.layer_of.len());
    }

    #[test]
    fn avoidable_crossings_are_removed() {
        // Two chains with crossed indices, and two nodes that all read.
        let tangled = [(0, 5), (1, 4), (2, 3), (5, 6), (4, 7), (3, 8), (6, 9), (7, 9), (8, 9)];
        let layers = Layers::new(10, &tangled);
        assert_eq!(layers.crossings(), 0, "{:?}", layers.layers);
        // Two distant readers share the common part of the path.
        let shared = Layers::new(5, &[(0, 1), (1, 2), (2, 3), (3, 4), (0, 3), (0, 4)]);
        assert_eq!(shared.layer_of.len(), 5 + 3, "{:?}", shared.paths);
        // Two edges of K(2,2) always cross.
        assert_eq!(Layers::new(4, &[(0, 2), (0, 3), (1, 2), (1, 3)]).crossings(), 1);
    }

    #[test]
    fn cycles_terminate() {
        let layers = Layers::new(3, &[(0, 1), (1, 2), (2, 0)]);
        assert!(layers.layer_of.iter().all(|layer| *layer < 3));
        assert_eq!(Layers::new(0, &[]).layers.len(), 0);
    }
}
