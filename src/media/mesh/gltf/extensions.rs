//! Extensions that a file says it needs, and which of them matter to a shape.

use super::document::Root;
use crate::mesh::trouble::ModelError;
use eddy_project::listed;

/// Extensions that change where vertices lie or which are drawn, and that this module reads, or tells of where they
/// are met: compressed data may have a plain fallback.
const READ: [&str; 6] = [
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
];

/// Extensions that leave a shape as the rest of the file has it: they say more about it, or offer a second way to draw
/// the same.
const BESIDE: [&str; 18] = [
    "AGI_articulations",
    "AGI_stk_metadata",
    "CESIUM_primitive_outline",
    "EXT_feature_metadata",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_mesh_primitive_edge_visibility",
    "EXT_mesh_primitive_restart",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "GODOT_single_root",
    "KHR_gaussian_splatting",
    "KHR_interactivity",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "VRM",
    "VRMC_springBone",
    "VRMC_vrm",
];

/// Areas of extensions, as their names say behind the vendor: `VENDOR_AREA_feature`. All of these are left aside with
/// what they extend.
const AREAS: [&str; 12] = [
    "animation",
    "audio",
    "collision",
    "instance",
    "lights",
    "lod",
    "materials",
    "packing",
    "physics",
    "techniques",
    "texture",
    "xmp",
];

/// Checks that the file needs nothing that Eddy cannot read.
pub(super) fn check(root: &Root<'_>) -> Result<(), ModelError> {
    let mut unknown: Vec<&str> = root.extensions_required.iter().map(|name| &*name.0).collect();
    unknown.retain(|name| !is_known(name));
    unknown.sort_unstable();
    unknown.dedup();
    if unknown.is_empty() {
        return Ok(());
    }
    // A list of thousands says no more than its start does.
    const SHOWN: usize = 5;
    let more = unknown.len().saturating_sub(SHOWN);
    let mut shown: Vec<String> = unknown.into_iter().take(SHOWN).map(ModelError::short).collect();
    if more > 0 {
        shown.push(format!("{more} more"));
    }
    let which = if shown.len() == 1 { "it" } else { "them" };
    Err(ModelError::Needs {
        what: listed(&shown),
        because: String::new(),
        mend: format!("re-export the model without {which}"),
    })
}

fn is_known(name: &str) -> bool {
    let area = name.split('_').nth(1).unwrap_or_default();
    READ.contains(&name) || BESIDE.contains(&name) || AREAS.contains(&area)
}

/// Returns whether attributes may be quantised.
pub(super) fn is_quantized(root: &Root<'_>) -> bool {
    let mut names = root.extensions_used.iter().chain(&root.extensions_required);
    names.any(|name| name.0 == "KHR_mesh_quantization")
}

/// The trouble of a mesh that is there in Draco's form alone.
pub(super) fn draco() -> ModelError {
    ModelError::Needs {
        what: "KHR_draco_mesh_compression".into(),
        because: "its mesh is Draco compressed".into(),
        mend: "re-export the model without compression, or unpack it: gltf-transform copy IN.glb OUT.glb".into(),
    }
}

/// The trouble of a buffer view that is there in meshoptimizer's form alone.
pub(super) fn meshopt(extension: &str) -> ModelError {
    ModelError::Needs {
        what: extension.into(),
        because: "its mesh is meshopt compressed".into(),
        mend: "re-export the model without compression (gltfpack without -c), or unpack it: gltf-transform copy \
               IN.glb OUT.glb"
            .into(),
    }
}
