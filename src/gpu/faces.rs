//! Faces of cubemaps as flat textures, for OpenGL.
//!
//! wgpu has no texture views on OpenGL: a view of one face binds the whole cubemap, which a shader then reads as black.
//! It does not copy from a cubemap either (`wgpu-hal/src/gles/queue.rs`, `CopyTextureToTexture` and
//! `CopyTextureToBuffer`). So a face is drawn into a flat texture, with reads at the centres of its texels. Drawing
//! into a face works.

use super::{Binding, Gpu, GpuError, Texture, TextureDescriptor, bindings, full_screen};
use eddy_texture::{Dimension, Face, TextureShape};
use std::{
    collections::HashMap,
    fmt::Write,
    sync::{Mutex, OnceLock, PoisonError},
};

const LABEL: &str = "face";

/// Returns the shader: `place` is the face, the level, and the number of texels of a side.
fn shader() -> String {
    let mut cases = String::new();
    for (index, face) in Face::ALL.into_iter().enumerate() {
        // Each component is one of 1, -1, s, -s, t, -t: its values at three points tell which.
        let [middle, right, up] = [face.direction(0.0, 0.0), face.direction(1.0, 0.0), face.direction(0.0, 1.0)];
        let part = |i: usize| {
            // No negative zero.
            let [constant, s, t] = [middle[i], right[i] - middle[i], up[i] - middle[i]].map(|factor| factor + 0.0);
            format!("{constant:?} + {s:?} * s + {t:?} * t")
        };
        let _ = writeln!(cases, "case {index}u: {{ direction = vec3({}, {}, {}); }}", part(0), part(1), part(2));
    }
    format!(
        "
@group(0) @binding(0) var cube: texture_cube<f32>;
@group(0) @binding(1) var nearest: sampler;
@group(0) @binding(2) var<uniform> place: vec4<f32>;

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {{
    let s = position.x / place.z * 2.0 - 1.0;
    let t = position.y / place.z * 2.0 - 1.0;
    var direction = vec3(0.0);
    switch u32(place.x) {{
        {cases}
        default: {{}}
    }}
    return textureSampleLevel(cube, nearest, direction, place.y);
}}
"
    )
}

/// The device's [`FaceCopier`], created for the first cubemap.
#[derive(Default)]
pub(super) struct Faces(OnceLock<FaceCopier>);

impl Faces {
    fn get(&self, gpu: &Gpu) -> &FaceCopier {
        self.0.get_or_init(|| FaceCopier::new(gpu))
    }
}

/// Draws faces of cubemaps into flat textures.
struct FaceCopier {
    fragment: wgpu::ShaderModule,
    nearest: wgpu::Sampler,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    pipelines: Mutex<HashMap<wgpu::TextureFormat, wgpu::RenderPipeline>>,
}

/// A level of a face that is drawn into other textures.
pub(super) struct BoundFace {
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl FaceCopier {
    fn new(gpu: &Gpu) -> Self {
        let cube = Binding::Texture { dimension: wgpu::TextureViewDimension::Cube, filterable: false };
        let group = vec![(0, cube), (1, Binding::Sampler { filtering: false }), (2, Binding::Uniform { bytes: 16 })];
        let layout = bindings::layouts(gpu, LABEL, &[group], wgpu::ShaderStages::FRAGMENT).remove(0);
        let nearest = gpu.device.create_sampler(&wgpu::SamplerDescriptor { label: Some(LABEL), ..Default::default() });
        let fragment = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(LABEL),
            source: wgpu::ShaderSource::Wgsl(shader().into()),
        });
        let pipeline_layout = bindings::pipeline_layout(gpu, LABEL, std::slice::from_ref(&layout));
        Self { fragment, nearest, layout, pipeline_layout, pipelines: Mutex::default() }
    }

    /// Binds a level of a face, to be drawn into textures of the same format.
    fn bind(&self, gpu: &Gpu, cube: &Texture, (face, level): (u32, u32)) -> BoundFace {
        let [side, ..] = cube.shape.level(level);
        let place = [face as f32, level as f32, side as f32, 0.0];
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(LABEL),
            size: size_of_val(&place) as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue.write_buffer(&uniform, 0, bytemuck::cast_slice(&place));
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(LABEL),
            layout: &self.layout,
            entries: &[
                entry(0, wgpu::BindingResource::TextureView(&cube.all_levels)),
                entry(1, wgpu::BindingResource::Sampler(&self.nearest)),
                entry(2, uniform.as_entire_binding()),
            ],
        });
        let format = cube.raw.format();
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        let pipeline = pipelines.entry(format).or_insert_with(|| {
            full_screen::pipeline(gpu, LABEL, &self.pipeline_layout, (&self.fragment, "fragment"), &[(format, true)])
        });
        BoundFace { group, pipeline: pipeline.clone() }
    }
}

impl BoundFace {
    /// Draws the face from row 0, column 0 of a target, as far as it goes.
    pub(super) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        (width, height): (u32, u32),
    ) {
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some(LABEL),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        };
        gpu.pass(encoder, descriptor, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.set_scissor_rect(0, 0, width, height);
            pass.draw(0..3, 0..1);
        });
    }
}

impl Texture {
    /// Returns a level of a face for drawing it into flat textures, where the device cannot read it through a view of
    /// its own.
    pub(super) fn bound_face(&self, gpu: &Gpu, face: u32, level: u32) -> Option<BoundFace> {
        let faces = gpu.faces.as_ref().filter(|_| self.shape.dimension == Dimension::Cube)?;
        Some(faces.get(gpu).bind(gpu, self, (face, level)))
    }

    /// Returns a flat texture of the size and format of a level.
    pub(super) fn flat_level(&self, gpu: &Gpu, level: u32) -> Result<Texture, GpuError> {
        let [width, height, _] = self.shape.level(level);
        let shape = TextureShape::flat(width, height, self.shape.format);
        Texture::new(gpu, &TextureDescriptor { label: LABEL, shape, is_target: true })
    }

    /// Returns a flat copy of a level of a face, where the device cannot read it through a view of its own.
    pub(super) fn flat_copy(&self, gpu: &Gpu, face: u32, level: u32) -> Result<Option<Texture>, GpuError> {
        let Some(bound) = self.bound_face(gpu, face, level) else { return Ok(None) };
        let flat = self.flat_level(gpu, level)?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(LABEL) });
        bound.draw(gpu, &mut encoder, &flat.level_0, (flat.width(), flat.height()));
        gpu.queue.submit([encoder.finish()]);
        Ok(Some(flat))
    }

    /// Returns a flat view of a level of a layer for reading by shaders. On OpenGL, that of a cube is of a copy, which
    /// contains what was submitted before this call.
    pub fn readable(&self, gpu: &Gpu, layer: u32, level: u32) -> Result<wgpu::TextureView, GpuError> {
        Ok(match self.flat_copy(gpu, layer, level)? {
            Some(flat) => flat.level_0,
            None if level == 0 => self.layer(layer).clone(),
            None => self.level("level", layer, level),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shader_has_the_directions_of_all_faces() {
        let shader = shader();
        let first = "vec3(1.0 + 0.0 * s + 0.0 * t, 0.0 + 0.0 * s + -1.0 * t, 0.0 + -1.0 * s + 0.0 * t)";
        assert!(shader.contains(&format!("case 0u: {{ direction = {first}; }}")), "{shader}");
        assert_eq!(shader.matches("case ").count(), 6);
    }
}
