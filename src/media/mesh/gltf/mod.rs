//! glTF 2.0: every triangle of the scene, with the transforms of its nodes applied, its skins posed by the nodes, and
//! its morph targets at the weights of the file. Materials and animations are ignored.
//!
//! Section numbers in comments refer to the glTF 2.0 specification. The text is parsed into `document` by serde, and
//! elements of accessors by `accessors`, because the crate `gltf` (1.4.1) rejects valid files: it does not support
//! extensions that leave the shape unchanged, attributes of applications, scenes without nodes, or accessors of zeros,
//! and its readers treat quantised attributes as floats.
//!
//! The file may be damaged or malicious, so all of it is checked before it is used, and its size is computed before
//! memory is allocated: the chunks in `container`, the text in `json`, the hierarchy in `nodes`, the bytes in
//! `buffers`, and the elements that are read in `accessors`.

mod accessors;
mod buffers;
mod container;
mod document;
mod extensions;
mod instances;
mod json;
mod nodes;
mod primitive;
mod skins;
mod texture;

use super::{
    model::Raw,
    trouble::{Counts, ModelError},
};
use accessors::Source;
use buffers::{Buffers, Named};
use document::{Index, Root};
use nodes::{MeshInstance, Stage};
use primitive::{Mode, Part, Pose};
use skins::{Bound, Skins, skin_of};
use texture::Transform;

/// Reads the bytes of a `.gltf` or `.glb` file, and passes every part of it to `take`. Returns the parts of the scene
/// that are not triangles and were skipped.
pub(super) fn load(
    bytes: &[u8],
    named: Named<'_>,
    room: u64,
    take: &mut dyn FnMut(Raw) -> Result<(), ModelError>,
) -> Result<IgnoredParts, ModelError> {
    let chunks = container::split(bytes)?;
    let root = json::document(chunks.json)?;
    let stage = Stage::of(&root)?;
    let is_quantized = extensions::is_quantized(&root);
    let textures = if is_quantized { texture::transforms(&root) } else { Vec::new() };
    let buffers = Buffers::load(&root, chunks.binary, named, bytes.len() as u64)?;
    let model = Model { source: Source { root: &root, buffers: &buffers, is_quantized }, textures: &textures };
    let mut counts = Counts::of_file(bytes.len() as u64 + buffers.bytes());
    let left_out = model.count(&stage, &mut counts)?;
    counts.fit(room)?;
    let skins = Skins::load(model.source, &stage)?;
    for placed in &stage.placed {
        for (n, part) in model.parts(placed) {
            model.take(placed, part, &skins, take).map_err(|trouble| trouble.at(|| place(n, placed)))?;
        }
    }
    Ok(left_out)
}

/// The parts of a file that are not drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct IgnoredParts {
    pub points: bool,
    pub lines: bool,
    /// Triangles without positions, which section 3.7.2.1 lets readers skip.
    pub unplaced: bool,
    /// Meshes of nodes that are hidden or outside the scene.
    pub unseen: bool,
}

impl IgnoredParts {
    /// Returns the words that follow "holds no triangles" in a message about a file without triangles.
    pub(super) fn only(self) -> String {
        match self.beside() {
            Some(what) => format!(", only {what}"),
            None if self.unplaced => ": its meshes have no positions".into(),
            None if self.unseen => ": its meshes are in no node of its scene that is visible".into(),
            None => String::new(),
        }
    }

    /// Returns the name of the parts that are not triangles.
    pub(super) fn beside(self) -> Option<&'static str> {
        match (self.points, self.lines) {
            (true, true) => Some("points and lines"),
            (true, false) => Some("points"),
            (false, true) => Some("lines"),
            (false, false) => None,
        }
    }
}

/// Returns the words for the location of a primitive.
fn place(primitive: usize, placed: &MeshInstance) -> String {
    match placed.node {
        Some(node) => format!("primitive {primitive} of node {node}"),
        None => format!("primitive {primitive} of mesh {}", placed.mesh),
    }
}

#[derive(Clone, Copy)]
struct Model<'a> {
    source: Source<'a>,
    textures: &'a [Option<Transform>],
}

impl<'a> Model<'a> {
    /// Returns the primitives of a placed mesh with their indices.
    fn parts(self, placed: &MeshInstance) -> impl Iterator<Item = (usize, Result<Part<'a>, ModelError>)> {
        let root: &'a Root<'a> = self.source.root;
        let mesh = &root.meshes[placed.mesh as usize];
        let of_node = placed.node.and_then(|node| root.nodes[node as usize].weights.as_deref());
        let weights = of_node.or(mesh.weights.as_deref()).unwrap_or_default();
        mesh.primitives.iter().enumerate().map(move |(n, primitive)| {
            let part = |mode| Part { source: self.source, primitive, mode, weights, textures: self.textures };
            (n, Mode::of(primitive).map(part))
        })
    }

    /// Counts the sizes of all parts, by the counts of their accessors.
    fn count(self, stage: &Stage, counts: &mut Counts) -> Result<IgnoredParts, ModelError> {
        let root: &Root<'_> = self.source.root;
        let count = |index: Index| root.accessors[index as usize].count;
        let mut left_out = IgnoredParts::default();
        for placed in &stage.placed {
            let instances = instances::count(self.source, placed.node)?;
            for (n, part) in self.parts(placed) {
                let part = part.map_err(|trouble| trouble.at(|| place(n, placed)))?;
                // Parts that are not drawn are also visited once per node.
                counts.add_part()?;
                counts.add_moved(part.primitive.targets.len() as u64)?;
                match (part.mode, part.attributes().position) {
                    (Mode::Points, _) => left_out.points = true,
                    (Mode::Lines, _) => left_out.lines = true,
                    (_, None) => left_out.unplaced = true,
                    (mode, Some(positions)) => {
                        let vertices = count(positions);
                        let triangles = mode.triangles(part.primitive.indices.map_or(vertices, count));
                        let sets = part.attributes().joints.len().max(part.attributes().weights.len());
                        let times = (part.targets().count() + sets) as u64;
                        counts.add_parts(instances.saturating_sub(1))?;
                        counts.add(vertices.saturating_mul(instances), triangles.saturating_mul(instances))?;
                        counts.add_moved(vertices.saturating_mul(instances).saturating_mul(times))?;
                        let zeros = |index: Index| if part.is_compressed() { 0 } else { self.source.zeros(index) };
                        let of_part = zeros(positions).saturating_add(part.primitive.indices.map_or(0, zeros));
                        counts.add_zeros(instances::zeros(self.source, placed.node))?;
                        counts.add_zeros(of_part.saturating_mul(instances))?;
                    }
                }
            }
        }
        Skins::count(self.source, stage, counts)?;
        left_out.unseen = counts.triangles == 0 && stage.placed.len() < root.meshes.len();
        Ok(left_out)
    }

    /// Passes a part to `take`, for every place of its mesh.
    fn take(
        self,
        placed: &MeshInstance,
        part: Result<Part<'a>, ModelError>,
        skins: &'a Skins,
        take: &mut dyn FnMut(Raw) -> Result<(), ModelError>,
    ) -> Result<(), ModelError> {
        let part = part?;
        if matches!(part.mode, Mode::Points | Mode::Lines) || part.attributes().position.is_none() {
            return Ok(());
        }
        if let Some(skin) = skin_of(self.source, placed)
            && let Some(bound) = Bound::of(self.source, part.attributes(), skin, skins.joints(skin))?
        {
            return take(part.raw(&Pose::Bound(bound))?);
        }
        instances::each(self.source, placed, |to_world| take(part.raw(&Pose::Placed(to_world))?))
    }
}
