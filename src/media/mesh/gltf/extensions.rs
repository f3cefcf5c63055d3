//! The extensions that a file requires, and which of them affect a shape.

use super::document::Root;
use crate::mesh::trouble::ModelError;
use eddy_project::listed;

/// Extensions that change the positions of vertices or which of them are drawn, and that this module reads, or reports
/// where they are used: compressed data may have a plain fallback.
const READ: [&str; 6] = [
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
];

/// Extensions that do not change the shape in the rest of the file: they add information, or offer a second way to draw
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

/// The areas of extensions by their names, after the vendor: `VENDOR_AREA_feature`. All of these are ignored together
/// with what they extend.
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

/// Checks that the file requires nothing that Eddy cannot read.
pub(super) fn check(root: &Root<'_>) -> Result<(), ModelError> {
    let mut unknown: Vec<&str> = root.extensions_required.iter().map(|name| &*name.0).collect();
    unknown.retain(|name| !is_known(name));
    unknown.sort_unstable();
    unknown.dedup();
    if unknown.is_empty() {
        return Ok(());
    }
    // The start of a long list is sufficient.
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
        hint: format!("re-export the model without {which}"),
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

/// Returns the error for a mesh that exists only in Draco's format.
pub(super) fn draco() -> ModelError {
    ModelError::Needs {
        what: "KHR_draco_mesh_compression".into(),
        because: "its mesh is Draco compressed".into(),
        hint: "re-export the model without compression, or unpack it: gltf-transform copy IN.glb OUT.glb".into(),
    }
}

/// Returns the error for a buffer view that exists only in meshoptimizer's format.
pub(super) fn meshopt(extension: &str) -> ModelError {
    ModelError::Needs {
        what: extension.into(),
        because: "its mesh is meshopt compressed".into(),
        hint: "re-export the model without compression (gltfpack without -c), or unpack it: gltf-transform copy \
               IN.glb OUT.glb"
            .into(),
    }
}
