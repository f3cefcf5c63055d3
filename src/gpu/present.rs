//! From a float picture whose row 0 is the bottom to 8 bits whose row 0 is the top, for a window.

use super::{Gpu, GpuError, Texture, TextureDescriptor};

const SHADER: &str = "
@group(0) @binding(0) var picture: texture_2d<f32>;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(picture));
    let texel = vec2<i32>(position.xy);
    let colour = textureLoad(picture, vec2(texel.x, size.y - 1 - texel.y), 0).rgb;
    // NaN shows as 0, as in every saved picture; a comparison with it is false.
    let bits = bitcast<vec3<u32>>(colour) & vec3(0x7fffffffu);
    return vec4(select(clamp(colour, vec3(0.0), vec3(1.0)), vec3(0.0), bits > vec3(0x7f800000u)), 1.0);
}
";

/// Draws pictures into a display texture (rgba8unorm).
pub struct Presenter {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl Presenter {
    pub fn new(gpu: &Gpu) -> Self {
        let shader = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("present"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("present"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("present"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let pipeline =
            super::pipeline::full_screen(gpu, "present", &pipeline_layout, &shader, &shader, "fragment", format);
        Self { layout, pipeline }
    }

    /// A display texture of the given size.
    pub fn texture(gpu: &Gpu, width: u32, height: u32) -> Result<Texture, GpuError> {
        let format = wgpu::TextureFormat::Rgba8Unorm;
        Texture::new(gpu, &TextureDescriptor { label: "display", width, height, format, levels: 1, is_target: true })
    }

    /// What [`Presenter::present`] needs to show one picture again and again.
    pub fn bind(&self, gpu: &Gpu, picture: &Texture) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("present"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&picture.level_0),
            }],
        })
    }

    /// Draws the picture into `display`, which has its size.
    pub fn present(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, picture: &wgpu::BindGroup, display: &Texture) {
        gpu.pass(
            encoder,
            wgpu::RenderPassDescriptor {
                label: Some("present"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &display.level_0,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: gpu.load_what_is_overwritten(), store: wgpu::StoreOp::Store },
                })],
                ..Default::default()
            },
            |pass| {
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, picture, &[]);
                pass.draw(0..3, 0..1);
            },
        );
    }
}
