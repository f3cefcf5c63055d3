//! Skins: how joints move the vertices that are bound to them (section 3.7.3).

use super::{
    accessors::{Elements, Source, Values},
    document::{Attributes, Index},
    nodes::{MeshInstance, Stage},
};
use crate::mesh::trouble::{Counts, ModelError};
use glam::{DAffine3, DMat3, DMat4, DVec3};
use std::collections::HashMap;

/// The skins in use, each with its joints' matrices from bind pose to current pose: the joint's world transform times
/// the inverse of its transform when it was bound.
pub(super) struct Skins(HashMap<Index, Vec<DAffine3>>);

impl Skins {
    /// Reads the skins of placed meshes. `counts` has counted their joints.
    pub(super) fn load(source: Source<'_>, stage: &Stage) -> Result<Skins, ModelError> {
        let mut skins = HashMap::new();
        for index in worn(source, &stage.placed) {
            if let std::collections::hash_map::Entry::Vacant(free) = skins.entry(index) {
                free.insert(joints(source, index, stage)?);
            }
        }
        Ok(Skins(skins))
    }

    /// Counts the joints of the skins of placed meshes.
    pub(super) fn count(source: Source<'_>, stage: &Stage, counts: &mut Counts) -> Result<(), ModelError> {
        let mut is_counted = vec![false; source.root.skins.len()];
        for index in worn(source, &stage.placed) {
            if !std::mem::replace(&mut is_counted[index as usize], true) {
                counts.add_joints(source.root.skins[index as usize].joints.len() as u64)?;
            }
        }
        Ok(())
    }

    pub(super) fn joints(&self, skin: Index) -> &[DAffine3] {
        self.0.get(&skin).map_or(&[], |joints| joints)
    }
}

/// Returns the skin of a placed mesh.
pub(super) fn skin_of(source: Source<'_>, placed: &MeshInstance) -> Option<Index> {
    source.root.nodes[placed.node? as usize].skin
}

fn worn<'a>(source: Source<'a>, placed: &'a [MeshInstance]) -> impl Iterator<Item = Index> + 'a {
    placed.iter().filter_map(move |placed| skin_of(source, placed))
}

fn joints(source: Source<'_>, index: Index, stage: &Stage) -> Result<Vec<DAffine3>, ModelError> {
    let skin = &source.root.skins[index as usize];
    let mut posed = Vec::with_capacity(skin.joints.len());
    for joint in &skin.joints {
        let Some(world) = stage.worlds[*joint as usize] else {
            return Err(ModelError::broken(format!("joint {joint} of skin {index} is its own descendant")));
        };
        posed.push(world);
    }
    let Some(bind) = skin.inverse_bind_matrices else { return Ok(posed) };
    let bind = source.values(bind, Elements::MATRICES, "inverseBindMatrices")?;
    if bind.count < posed.len() {
        let (joints, there) = (posed.len(), bind.count);
        return Err(ModelError::broken(format!("skin {index} has {joints} joints and {there} inverseBindMatrices")));
    }
    for (joint, bind) in posed.iter_mut().zip(bind.floats([0.0; 16])) {
        *joint *= DAffine3::from_mat4(DMat4::from_cols_array(&bind.map(f64::from)));
    }
    Ok(posed)
}

/// The joints of each vertex of a primitive with their weights, in sets of four.
pub(super) struct Bound<'a> {
    skin: Index,
    joints: &'a [DAffine3],
    sets: Vec<(Values<'a>, Values<'a>)>,
}

impl<'a> Bound<'a> {
    /// Returns `None` for a primitive without joints, which is placed at its node.
    pub(super) fn of(
        source: Source<'a>,
        attributes: &Attributes,
        skin: Index,
        joints: &'a [DAffine3],
    ) -> Result<Option<Bound<'a>>, ModelError> {
        let (of_joints, of_weights) = (&attributes.joints, &attributes.weights);
        if !of_joints.iter().map(|(set, _)| set).eq(of_weights.iter().map(|(set, _)| set)) {
            let (a, b) = (of_joints.len(), of_weights.len());
            let why = format!("it has {a} attributes JOINTS_n and {b} WEIGHTS_n, which are not the same sets");
            return Err(ModelError::broken(why));
        }
        let mut sets = Vec::with_capacity(of_joints.len());
        for ((set, joints), (_, weights)) in of_joints.iter().zip(of_weights) {
            let joints = source.values(*joints, Elements::JOINTS, &format!("JOINTS_{set}"))?;
            let weights = source.values(*weights, Elements::WEIGHTS, &format!("WEIGHTS_{set}"))?;
            sets.push((joints, weights));
        }
        Ok((!sets.is_empty()).then_some(Bound { skin, joints, sets }))
    }

    /// Returns the number of elements of each of its attributes.
    pub(super) fn counts(&self) -> impl Iterator<Item = (&'static str, usize)> {
        self.sets.iter().flat_map(|(joints, weights)| [("joints", joints.count), ("weights", weights.count)])
    }

    /// Passes the transform of each vertex to `take`, in order: the mean of its joints' transforms by weight. The
    /// weights sum to 1 in files that conform to section 3.7.3.3. A vertex that is not bound follows its first joint,
    /// as in other viewers.
    pub(super) fn each(&self, mut take: impl FnMut(usize, DAffine3)) -> Result<(), ModelError> {
        let count = self.sets.first().map_or(0, |(joints, _)| joints.count);
        let mut sets: Vec<_> = self.sets.iter().map(|(j, w)| j.floats([0.0; 4]).zip(w.floats([0.0; 4]))).collect();
        for vertex in 0..count {
            let joint = |joint: f32| {
                self.joints.get(joint as usize).ok_or_else(|| {
                    let (skin, there) = (self.skin, self.joints.len());
                    ModelError::broken(format!(
                        "vertex {vertex} is bound to joint {joint} of skin {skin}, which has {there}"
                    ))
                })
            };
            let (mut matrix, mut moved, mut sum) = (DMat3::ZERO, DVec3::ZERO, 0.0);
            let mut first = 0.0;
            for (set, values) in sets.iter_mut().enumerate() {
                let Some((joints, weights)) = values.next() else { continue };
                first = if set == 0 { joints[0] } else { first };
                for (index, weight) in joints.into_iter().zip(weights) {
                    // A joint without weight may have any index.
                    if weight != 0.0 {
                        let (posed, weight) = (joint(index)?, f64::from(weight));
                        matrix += posed.matrix3 * weight;
                        moved += posed.translation * weight;
                        sum += weight;
                    }
                }
            }
            take(
                vertex,
                match sum {
                    0.0 => *joint(first)?,
                    _ => DAffine3 { matrix3: matrix * (1.0 / sum), translation: moved / sum },
                },
            );
        }
        Ok(())
    }
}
