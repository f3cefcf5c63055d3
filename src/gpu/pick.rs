//! The texels of many textures at one place, read together.

use super::{Gpu, GpuError, Readback, Texture, TextureDescriptor, bindings::pipeline_layout, full_screen};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// The place is a part of the texture's width and height, as textures may differ in size.
const SHADER: &str = "
@group(0) @binding(0) var values: texture_2d<f32>;
@group(0) @binding(1) var<uniform> place: vec4<f32>;

@fragment fn fragment() -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(values));
    let texel = vec2<i32>(place.xy * vec2<f32>(size));
    return textureLoad(values, clamp(texel, vec2(0), size - 1), 0);
}
";

/// Reads one texel of each of several textures, of any formats and sizes.
pub struct TexelPicker {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    uniform: wgpu::Buffer,
    readback: Readback,
}

impl TexelPicker {
    pub fn new(gpu: &Gpu) -> Self {
        let label = "texels at a place";
        let fragment = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let layout = full_screen::values_layout(gpu, label);
        let pipeline_layout = pipeline_layout(gpu, label, std::slice::from_ref(&layout));
        let pipeline = full_screen::pipeline(gpu, label, &pipeline_layout, (&fragment, "fragment"), FORMAT);
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: 32,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { layout, pipeline, uniform, readback: Readback::default() }
    }

    /// Returns the texel of each texture at a place, from 0 to 1 across and up: missing components as 0, alpha as 1.
    /// Waits for the device once.
    pub fn pick(&mut self, gpu: &Gpu, textures: &[&Texture], at: [f32; 2]) -> Result<Vec<[f32; 4]>, GpuError> {
        if textures.is_empty() {
            return Ok(Vec::new());
        }
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::cast_slice(&[at[0], at[1], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
        let row = Texture::new(
            gpu,
            &TextureDescriptor {
                label: "texels at a place",
                width: textures.len() as u32,
                height: 1,
                format: FORMAT,
                levels: 1,
                is_target: true,
            },
        )?;
        let bound: Vec<_> = textures
            .iter()
            .map(|texture| full_screen::bind_values(gpu, &self.layout, texture, &self.uniform))
            .collect();
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("texels at a place") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let target = row.attachment(wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT));
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some("texels at a place"),
            color_attachments: &[Some(target)],
            ..Default::default()
        };
        gpu.pass(&mut encoder, descriptor, |pass| {
            pass.set_pipeline(&self.pipeline);
            for (index, bound) in bound.iter().enumerate() {
                pass.set_bind_group(0, bound, &[]);
                // The triangle covers everything: only this texel of it is drawn.
                pass.set_scissor_rect(index as u32, 0, 1, 1);
                pass.draw(0..3, 0..1);
            }
        });
        gpu.queue.submit([encoder.finish()]);
        self.readback.rgba32float(gpu, &row)
    }
}
