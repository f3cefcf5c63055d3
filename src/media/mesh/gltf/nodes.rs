//! The node hierarchy: a set of strict trees (section 3.5.2), which a file may violate.

use super::document::{Index, Node, Root};
use crate::mesh::trouble::ModelError;
use glam::{DAffine3, DMat4, DQuat, DVec3};

/// A mesh at its place.
pub(super) struct MeshInstance {
    pub mesh: Index,
    /// `None` for a file that has meshes but no nodes.
    pub node: Option<Index>,
    pub to_world: DAffine3,
}

/// The nodes that are drawn, and the world transform of every node.
pub(super) struct Stage {
    /// Parents precede children.
    pub placed: Vec<MeshInstance>,
    /// By node; `None` for those that are their own ancestors.
    pub worlds: Vec<Option<DAffine3>>,
}

impl Stage {
    pub(super) fn of(root: &Root<'_>) -> Result<Stage, ModelError> {
        let nodes = &root.nodes;
        let mut walk = Walk { nodes, reached: vec![None; nodes.len()], worlds: vec![None; nodes.len()] };
        let mut placed = Vec::new();
        let scene = scene(root);
        walk.from(&scene.map_or_else(|| roots(nodes), |scene| root.scenes[scene].nodes.clone()), &mut placed)?;
        // Joints may be outside the scene, whose other nodes are not drawn.
        if !root.skins.is_empty() {
            walk.beside();
        }
        if nodes.is_empty() {
            // A library of meshes (section 3.5.1): all of them are drawn.
            let mesh = |mesh| MeshInstance { mesh, node: None, to_world: DAffine3::IDENTITY };
            placed.extend((0..root.meshes.len() as Index).map(mesh));
        }
        Ok(Stage { placed, worlds: walk.worlds })
    }
}

/// Returns the default scene, otherwise the first.
fn scene(root: &Root<'_>) -> Option<usize> {
    root.scene.map(|scene| scene as usize).or_else(|| (!root.scenes.is_empty()).then_some(0))
}

/// Returns the nodes that have no parent.
fn roots(nodes: &[Node]) -> Vec<Index> {
    let mut is_child = vec![false; nodes.len()];
    nodes.iter().flat_map(|node| &node.children).for_each(|child| is_child[*child as usize] = true);
    (0..nodes.len() as Index).filter(|node| !is_child[*node as usize]).collect()
}

struct Walk<'a> {
    nodes: &'a [Node],
    /// By node: whether it was reached, and from where.
    reached: Vec<Option<Option<Index>>>,
    worlds: Vec<Option<DAffine3>>,
}

impl Walk<'_> {
    fn from(&mut self, roots: &[Index], placed: &mut Vec<MeshInstance>) -> Result<(), ModelError> {
        struct Open {
            node: Index,
            parent: Option<Index>,
            parent_to_world: DAffine3,
            is_shown: bool,
        }
        // Not recursive, as a chain of nodes may be longer than the stack is deep.
        let open =
            |node: &Index| Open { node: *node, parent: None, parent_to_world: DAffine3::IDENTITY, is_shown: true };
        let mut stack: Vec<Open> = roots.iter().rev().map(open).collect();
        while let Some(Open { node: index, parent, parent_to_world, is_shown }) = stack.pop() {
            let n = index as usize;
            if let Some(earlier) = self.reached[n] {
                return Err(ModelError::broken(twice(index, earlier, parent, &self.reached)));
            }
            self.reached[n] = Some(parent);
            let node = &self.nodes[n];
            let to_world = parent_to_world * local(node);
            self.worlds[n] = Some(to_world);
            // An invisible node hides its descendants (KHR_node_visibility).
            let is_shown = is_shown && node.extensions.visibility.as_ref().is_none_or(|v| v.visible);
            let parent = Some(index);
            let child = |node: &Index| Open { node: *node, parent, parent_to_world: to_world, is_shown };
            stack.extend(node.children.iter().rev().map(child));
            if let Some(mesh) = node.mesh.filter(|_| is_shown) {
                placed.push(MeshInstance { mesh, node: Some(index), to_world });
            }
        }
        Ok(())
    }

    /// Computes the transforms of nodes outside the scene, as far as they form trees.
    fn beside(&mut self) {
        let open = |node: Index| (node, DAffine3::IDENTITY);
        let mut stack: Vec<(Index, DAffine3)> = roots(self.nodes).into_iter().map(open).collect();
        while let Some((index, parent_to_world)) = stack.pop() {
            let n = index as usize;
            // Nodes of the scene have been visited with all their descendants.
            if self.worlds[n].is_none() {
                let to_world = parent_to_world * local(&self.nodes[n]);
                self.worlds[n] = Some(to_world);
                stack.extend(self.nodes[n].children.iter().map(|child| (*child, to_world)));
            }
        }
    }
}

/// Returns a node's transform to its parent (section 3.5.3).
fn local(node: &Node) -> DAffine3 {
    if let Some(matrix) = &node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
    }
    let vector = |v: Option<[f64; 3]>, default| v.map_or(default, DVec3::from);
    placement(vector(node.translation, DVec3::ZERO), node.rotation, vector(node.scale, DVec3::ONE))
}

/// Scales, then rotates, then translates. A quaternion of length zero does not rotate.
pub(super) fn placement(translation: DVec3, rotation: Option<[f64; 4]>, scale: DVec3) -> DAffine3 {
    let turn = rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let length = turn.length();
    let turn = if length.is_finite() && length > 0.0 { turn / length } else { DQuat::IDENTITY };
    DAffine3::from_scale_rotation_translation(scale, turn, translation)
}

/// Describes the error of a node that is reached a second time.
fn twice(node: Index, earlier: Option<Index>, now: Option<Index>, reached: &[Option<Option<Index>>]) -> String {
    // The parents of nodes that were reached form no cycle, so this ends.
    let mut above = now;
    while let Some(n) = above {
        if n == node {
            return format!("node {node} is a child of itself");
        }
        above = reached[n as usize].flatten();
    }
    let rule = "in glTF a node has at most one parent, and is in a scene once";
    match (earlier, now) {
        (Some(a), Some(b)) if a == b => format!("node {node} is twice a child of node {a}; {rule}"),
        (Some(a), Some(b)) => format!("node {node} is a child of node {a} and of node {b}; {rule}"),
        (None, Some(a)) | (Some(a), None) => {
            format!("node {node} is a child of node {a} and a root of the scene; {rule}")
        }
        (None, None) => format!("the scene names node {node} twice; {rule}"),
    }
}
