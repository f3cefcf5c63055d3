//! Nodes in layers, as Sugiyama, Tagawa and Toda do it ("Methods for Visual Understanding of Hierarchical System
//! Structures", 1981): each behind what it reads, long edges through a node of their own in each layer between, and the
//! order within layers by barycentres until fewer edges cross no more.

use std::collections::BTreeMap;

/// From one node to another, by their numbers.
pub(super) type Edge = (usize, usize);

/// Sweeps over all layers, forth and back.
const SWEEPS: usize = 12;

/// Nodes in layers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layers {
    /// The layer of each node: first those that were given, then those on long edges.
    pub layer_of: Vec<usize>,
    /// The nodes of each layer from the top.
    pub layers: Vec<Vec<usize>>,
    /// The way of each edge that was given, node by node, one a layer.
    pub ways: Vec<Vec<usize>>,
}

impl Layers {
    /// Takes nodes and edges that go round in no circle; one that would is left out of the layering.
    pub(super) fn new(nodes: usize, edges: &[Edge]) -> Self {
        let mut layer_of = longest_paths(nodes, edges);
        let mut ways = Vec::with_capacity(edges.len());
        // What is read by many goes one way as far as it can, and branches off to each.
        let mut passing: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for &(from, to) in edges {
            let mut way = vec![from];
            for layer in layer_of[from] + 1..layer_of[to] {
                let node = *passing.entry((from, layer)).or_insert(layer_of.len());
                if node == layer_of.len() {
                    layer_of.push(layer);
                }
                way.push(node);
            }
            way.push(to);
            ways.push(way);
        }
        let count = layer_of.iter().max().map_or(0, |most| most + 1);
        let mut layers = vec![Vec::new(); count];
        layer_of.iter().enumerate().for_each(|(node, layer)| layers[*layer].push(node));
        let mut made = Self { layer_of, layers, ways };
        made.untangle();
        made
    }

    /// Edges between neighbouring layers, each once.
    pub(super) fn steps(&self) -> Vec<Edge> {
        let mut steps: Vec<Edge> =
            self.ways.iter().flat_map(|way| way.windows(2).map(|step| (step[0], step[1]))).collect();
        steps.sort_unstable();
        steps.dedup();
        steps
    }

    /// Orders the nodes of each layer by where their neighbours in the layer before are, forth and back.
    fn untangle(&mut self) {
        let (mut best, mut least) = (self.layers.clone(), self.crossings());
        let steps = self.steps();
        for sweep in 0..SWEEPS {
            let forth = sweep % 2 == 0;
            let count = self.layers.len();
            for step in 1..count {
                let layer = if forth { step } else { count - 1 - step };
                let place = self.places();
                let mut keyed: Vec<(f32, usize)> = Vec::new();
                for &node in &self.layers[layer] {
                    let other = |&(from, to): &Edge| match forth {
                        true if to == node && from != node => Some(from),
                        false if from == node && to != node => Some(to),
                        _ => None,
                    };
                    let near: Vec<f32> = steps.iter().filter_map(other).map(|other| place[other] as f32).collect();
                    let own = place[node] as f32;
                    let mean = if near.is_empty() { own } else { near.iter().sum::<f32>() / near.len() as f32 };
                    keyed.push((mean, node));
                }
                // Those of one barycentre stay as they were.
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

    /// The place of each node in its layer.
    fn places(&self) -> Vec<usize> {
        let mut places = vec![0; self.layer_of.len()];
        for layer in &self.layers {
            layer.iter().enumerate().for_each(|(place, node)| places[*node] = place);
        }
        places
    }

    /// Returns how many pairs of edges cross.
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

/// The layer of each node: behind the last of what leads to it.
fn longest_paths(nodes: usize, edges: &[Edge]) -> Vec<usize> {
    let mut layer = vec![0; nodes];
    // As many rounds as a path is long at most; in a circle it ends all the same.
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
    fn a_node_is_behind_all_that_it_reads_and_long_edges_pass_each_layer() {
        let layers = Layers::new(4, &[(0, 1), (1, 2), (0, 2), (3, 2)]);
        assert_eq!(&layers.layer_of[..4], [0, 1, 2, 0]);
        assert_eq!(layers.ways[2].len(), 3, "from 0 to 2 past 1");
        assert!(layers.steps().into_iter().all(|(from, to)| layers.layer_of[to] > layers.layer_of[from]));
        assert_eq!(layers.layers.iter().map(Vec::len).sum::<usize>(), layers.layer_of.len());
    }

    #[test]
    fn edges_that_need_not_cross_do_not() {
        // Two chains, named crosswise, and two that all read.
        let tangled = [(0, 5), (1, 4), (2, 3), (5, 6), (4, 7), (3, 8), (6, 9), (7, 9), (8, 9)];
        let layers = Layers::new(10, &tangled);
        assert_eq!(layers.crossings(), 0, "{:?}", layers.layers);
        // What two far readers share is one way.
        let shared = Layers::new(5, &[(0, 1), (1, 2), (2, 3), (3, 4), (0, 3), (0, 4)]);
        assert_eq!(shared.layer_of.len(), 5 + 3, "{:?}", shared.ways);
        // Of K(2,2) two edges always cross.
        assert_eq!(Layers::new(4, &[(0, 2), (0, 3), (1, 2), (1, 3)]).crossings(), 1);
    }

    #[test]
    fn a_circle_ends() {
        let layers = Layers::new(3, &[(0, 1), (1, 2), (2, 0)]);
        assert!(layers.layer_of.iter().all(|layer| *layer < 3));
        assert_eq!(Layers::new(0, &[]).layers.len(), 0);
    }
}
