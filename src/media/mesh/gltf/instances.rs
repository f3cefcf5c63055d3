//! Instancing: a mesh that one node shows at many places (`EXT_mesh_gpu_instancing`).

use super::{
    accessors::{Elements, Source},
    document::{Index, Instancing},
    nodes::{MeshInstance, placement},
};
use crate::mesh::trouble::ModelError;
use glam::{DAffine3, DVec3};

fn of(source: Source<'_>, node: Option<Index>) -> Option<&Instancing> {
    source.root.nodes.get(node? as usize)?.extensions.instancing.as_deref()
}

/// Returns how often a node shows its mesh.
pub(super) fn count(source: Source<'_>, node: Option<Index>) -> Result<u64, ModelError> {
    let Some(instancing) = of(source, node) else { return Ok(1) };
    let mut counts =
        instancing.attributes.all().map(|(name, index)| (name, source.root.accessors[index as usize].count));
    let Some((_, first)) = counts.next() else { return Ok(1) };
    match counts.find(|(_, count)| *count != first) {
        Some((name, count)) => {
            let node = node.unwrap_or_default();
            Err(ModelError::broken(format!("node {node} has {first} instances by one attribute and {count} by {name}")))
        }
        None => Ok(first),
    }
}

/// Returns the number of a node's instances that have no bytes in the file.
pub(super) fn zeros(source: Source<'_>, node: Option<Index>) -> u64 {
    let Some(instancing) = of(source, node) else { return 0 };
    instancing.attributes.all().map(|(_, index)| source.zeros(index)).min().unwrap_or(0)
}

/// Passes the transform of each of a node's instances to `take`; of a node without instances, its own.
pub(super) fn each(
    source: Source<'_>,
    placed: &MeshInstance,
    mut take: impl FnMut(DAffine3) -> Result<(), ModelError>,
) -> Result<(), ModelError> {
    let Some(attributes) = of(source, placed.node).map(|one| &one.attributes) else { return take(placed.to_world) };
    let values = |index: Option<Index>, kind, what: &str| {
        index.map(|index| source.values(index, kind, &format!("the {what} of instances"))).transpose()
    };
    let places = values(attributes.translation, Elements::PLACES, "TRANSLATION")?;
    let turns = values(attributes.rotation, Elements::TURNS, "ROTATION")?;
    let scales = values(attributes.scale, Elements::PLACES, "SCALE")?;
    let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let mut places = places.as_ref().map(|values| values.floats([0.0; 3]).map(vector));
    let mut turns = turns.as_ref().map(|values| values.floats([0.0; 4]).map(|turn| turn.map(f64::from)));
    let mut scales = scales.as_ref().map(|values| values.floats([1.0; 3]).map(vector));
    for _ in 0..count(source, placed.node)? {
        let place = places.as_mut().and_then(Iterator::next).unwrap_or(DVec3::ZERO);
        let turn = turns.as_mut().and_then(Iterator::next);
        let scale = scales.as_mut().and_then(Iterator::next).unwrap_or(DVec3::ONE);
        take(placed.to_world * placement(place, turn, scale))?;
    }
    Ok(())
}
