//! Any colour format to 32-bit floats, texel for texel, for reading back.

use super::{Gpu, GpuError, Texture, TextureDescriptor, pipeline::full_screen};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

const SHADER: &str = "
@group(0) @binding(0) var picture: texture_2d<f32>;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(picture, vec2<i32>(position.xy), 0);
}
";

/// Copies textures of any format to floats. Made once, as making a pipeline takes far longer than drawing with it.
pub struct FloatConverter {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl FloatConverter {
    pub fn new(gpu: &Gpu) -> Self {
        let shader = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("as floats"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let entry = wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("as floats"), entries: &[entry] });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("as floats"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = full_screen(gpu, "as floats", &pipeline_layout, &shader, &shader, "fragment", FORMAT);
        Self { layout, pipeline }
    }

    /// Level 0 of a texture as a new rgba32float texture: what a shader reads of it, missing components as 0, alpha as 1.
    pub fn convert(&self, gpu: &Gpu, picture: &Texture) -> Result<Texture, GpuError> {
        let (width, height) = (picture.width(), picture.height());
        let descriptor =
            TextureDescriptor { label: "as floats", width, height, format: FORMAT, levels: 1, is_target: true };
        let floats = Texture::new(gpu, &descriptor)?;
        let read = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("as floats"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&picture.level_0),
            }],
        });
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("as floats") });
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        gpu.pass(
            &mut encoder,
            wgpu::RenderPassDescriptor {
                label: Some("as floats"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &floats.level_0,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                ..Default::default()
            },
            |pass| {
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &read, &[]);
                pass.draw(0..3, 0..1);
            },
        );
        gpu.queue.submit([encoder.finish()]);
        Ok(floats)
    }
}
