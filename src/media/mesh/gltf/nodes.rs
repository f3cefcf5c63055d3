//! The node hierarchy: a set of strict trees (glTF 2.0, section 3.5.2), which a file may not keep to.

use crate::media::mesh::trouble::Trouble;
use glam::Mat4;
use gltf::{Document, Node};

/// The nodes of the scene that show a mesh, parents before children, each with its transform to the world.
pub(super) fn placed(document: &Document) -> Result<Vec<(Node<'_>, Mat4)>, Trouble> {
    // By node: reached, and from where.
    let mut reached: Vec<Option<Option<usize>>> = vec![None; document.nodes().len()];
    let mut placed = Vec::new();
    // Not by recursion, as a chain of nodes may be longer than the stack is deep.
    let mut open: Vec<(Node<'_>, Option<usize>, Mat4)> =
        roots(document).into_iter().rev().map(|node| (node, None, Mat4::IDENTITY)).collect();
    while let Some((node, parent, parent_to_world)) = open.pop() {
        let index = node.index();
        if let Some(earlier) = reached[index] {
            return Err(Trouble::broken(twice(index, earlier, parent, &reached)));
        }
        reached[index] = Some(parent);
        let to_world = parent_to_world * Mat4::from_cols_array_2d(&node.transform().matrix());
        let first = open.len();
        open.extend(node.children().map(|child| (child, Some(index), to_world)));
        open[first..].reverse();
        if node.mesh().is_some() {
            placed.push((node, to_world));
        }
    }
    Ok(placed)
}

/// Returns the roots of the default scene, else of the first scene, else every node that is nobody's child.
fn roots(document: &Document) -> Vec<Node<'_>> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        return scene.nodes().collect();
    }
    let mut is_child = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children().map(|c| c.index()).collect::<Vec<_>>()) {
        is_child[child] = true;
    }
    document.nodes().filter(|node| !is_child[node.index()]).collect()
}

/// Returns what is wrong with a node that is reached a second time.
fn twice(node: usize, earlier: Option<usize>, now: Option<usize>, reached: &[Option<Option<usize>>]) -> String {
    // Parents of nodes that were reached make no circle, so this ends.
    let mut above = now;
    while let Some(n) = above {
        if n == node {
            return format!("node {node} is a child of itself");
        }
        above = reached[n].flatten();
    }
    let rule = "in glTF a node has at most one parent, and stands in a scene once";
    match (earlier, now) {
        (Some(a), Some(b)) if a == b => format!("node {node} is twice a child of node {a}; {rule}"),
        (Some(a), Some(b)) => format!("node {node} is a child of node {a} and of node {b}; {rule}"),
        (None, Some(a)) | (Some(a), None) => {
            format!("node {node} is a child of node {a} and a root of the scene; {rule}")
        }
        (None, None) => format!("the scene names node {node} twice; {rule}"),
    }
}
