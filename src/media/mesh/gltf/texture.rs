//! Texture coordinates that are quantised to integers, and the `KHR_texture_transform` of their material, which
//! restores them.

use super::document::Root;
use serde::Deserialize;

#[derive(Clone, Copy, Deserialize)]
#[serde(default)]
pub(super) struct Transform {
    offset: [f32; 2],
    /// In radians.
    rotation: f32,
    scale: [f32; 2],
    /// A set that overrides the texture's own.
    #[serde(rename = "texCoord")]
    tex_coord: Option<u32>,
}

impl Default for Transform {
    fn default() -> Self {
        Transform { offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2], tex_coord: None }
    }
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Material {
    pbr_metallic_roughness: Metallic,
    normal_texture: Option<Texture>,
    occlusion_texture: Option<Texture>,
    emissive_texture: Option<Texture>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Metallic {
    base_color_texture: Option<Texture>,
    metallic_roughness_texture: Option<Texture>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Texture {
    tex_coord: u32,
    extensions: Extensions,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Extensions {
    #[serde(rename = "KHR_texture_transform")]
    transform: Option<Transform>,
}

/// Returns the transform of each material for the first set of coordinates: that of its colour, otherwise of another of
/// its textures. A program that quantises writes the same one to all. Empty if the materials are malformed, as they are
/// otherwise ignored.
pub(super) fn transforms(root: &Root<'_>) -> Vec<Option<Transform>> {
    let materials = root.materials.and_then(|text| serde_json::from_str::<Vec<Material>>(text.get()).ok());
    materials.unwrap_or_default().into_iter().map(|material| material.transform()).collect()
}

impl Material {
    fn transform(self) -> Option<Transform> {
        let Metallic { base_color_texture, metallic_roughness_texture } = self.pbr_metallic_roughness;
        let textures = [
            base_color_texture,
            metallic_roughness_texture,
            self.normal_texture,
            self.occlusion_texture,
            self.emissive_texture,
        ];
        let of_first_set = |t: Texture| t.extensions.transform.filter(|it| it.tex_coord.unwrap_or(t.tex_coord) == 0);
        textures.into_iter().flatten().find_map(of_first_set)
    }
}

impl Transform {
    /// Scales, then rotates, then translates, as in the extension's own shader.
    pub(super) fn apply(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let (sin, cos) = self.rotation.sin_cos();
        let (u, v) = (u * self.scale[0], v * self.scale[1]);
        [u * cos - v * sin + self.offset[0], u * sin + v * cos + self.offset[1]]
    }
}
