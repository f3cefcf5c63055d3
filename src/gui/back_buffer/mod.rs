//! The window's contents, kept from frame to frame, so that only what changes is painted.
//!
//! Owns a texture of the window's size. Painting the whole window takes a software driver many times as long as a line
//! of text, and costs a graphics device more power.

mod occlusion;

use super::damage::{Area, Damage, Versions};
use crate::gpu::Gpu;
use egui::{
    ClippedPrimitive, Color32, Rect, TextureId,
    epaint::{ImageDelta, Mesh, Primitive},
    pos2, vec2,
};
use egui_wgpu::{Renderer, ScreenDescriptor};
use occlusion::Part;

#[derive(Default)]
pub(super) struct BackBuffer {
    texture: Option<wgpu::Texture>,
    damage: Damage,
    /// The version of each changed texture, which is incremented by each change.
    versions: Versions,
}

/// A frame painted by egui.
pub(super) struct Painting<'a> {
    pub triangles: Vec<ClippedPrimitive>,
    pub screen: &'a ScreenDescriptor,
    pub format: wgpu::TextureFormat,
}

impl BackBuffer {
    /// Marks the texels of a texture as changed.
    pub(super) fn touch(&mut self, texture: TextureId) {
        *self.versions.entry(texture).or_default() += 1;
    }

    /// Records a change of one of egui's own textures.
    pub(super) fn update(&mut self, texture: TextureId, delta: &ImageDelta) {
        // A partial update of the font atlas adds a glyph: nothing that is visible reads it yet. An atlas that
        // overflows reuses the places of older glyphs, and is rebuilt as a whole in the next frame (epaint's
        // `TextureAtlas::allocate`).
        if texture != TextureId::default() || delta.is_whole() {
            self.touch(texture);
        }
    }

    /// Records the commands that update the contents. Returns the contents, and the command buffers to submit before
    /// `encoder`.
    pub(super) fn paint(
        &mut self,
        gpu: &Gpu,
        renderer: &mut Renderer,
        encoder: &mut wgpu::CommandEncoder,
        painting: Painting<'_>,
    ) -> (&wgpu::Texture, Vec<wgpu::CommandBuffer>) {
        let Painting { triangles, screen, format } = painting;
        let size = screen.size_in_pixels;
        if self.texture.as_ref().is_none_or(|t| [t.width(), t.height()] != size || t.format() != format) {
            self.texture = None;
            self.damage = Damage::default();
        }
        let areas = self.damage.of(&triangles, size, screen.pixels_per_point, &self.versions);
        let texture = self.texture.get_or_insert_with(|| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("window's contents"),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let commands = paint_areas(gpu, renderer, encoder, &view, triangles, screen, &areas);
        (texture, commands)
    }
}

/// Records the painting of some areas of a target; the others keep their pixels. Returns the command buffers to submit
/// before `encoder`.
pub(super) fn paint_areas(
    gpu: &Gpu,
    renderer: &mut Renderer,
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    mut triangles: Vec<ClippedPrimitive>,
    screen: &ScreenDescriptor,
    areas: &[Area],
) -> Vec<wgpu::CommandBuffer> {
    if areas.is_empty() {
        return Vec::new();
    }
    triangles.insert(0, ground(screen));
    let commands = renderer.update_buffers(&gpu.device, &gpu.queue, encoder, &triangles, screen);
    let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("window"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            depth_slice: None,
        })],
        ..Default::default()
    });
    let mut pass = pass.forget_lifetime();
    let clips: Vec<Rect> = triangles.iter().map(|triangles| triangles.clip_rect).collect();
    let scale = screen.pixels_per_point;
    let parts: Vec<Part> = areas.iter().flat_map(|area| occlusion::parts(&triangles, *area, scale)).collect();
    for part in parts {
        let area = part.area.in_points(scale);
        for (index, (triangles, clip)) in triangles.iter_mut().zip(&clips).enumerate() {
            let both = clip.intersect(area);
            let is_seen = index >= part.first && both.is_positive();
            triangles.clip_rect = if is_seen { both } else { Rect::ZERO };
        }
        renderer.render(&mut pass, &triangles, screen);
    }
    commands
}

/// Returns black below everything, so that places without a panel do not keep older pixels.
fn ground(screen: &ScreenDescriptor) -> ClippedPrimitive {
    let [width, height] = screen.size_in_pixels.map(|pixels| pixels as f32 / screen.pixels_per_point);
    let mut mesh = Mesh::default();
    // Slightly larger than the window, for a scale that does not divide its size.
    mesh.add_colored_rect(Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height)).expand(1.0), Color32::BLACK);
    ClippedPrimitive { clip_rect: Rect::EVERYTHING, primitive: Primitive::Mesh(mesh) }
}

#[cfg(test)]
mod tests;
