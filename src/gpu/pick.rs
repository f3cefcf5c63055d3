//! Reads the texels of many textures at one place together.

use super::{Gpu, GpuError, Readback, Texture, TextureDescriptor, full_screen::PictureShader, texture_format};
use eddy_texture::{TexelFormat, TextureShape};

const FORMAT: TexelFormat = TexelFormat::Rgba32f;

const LABEL: &str = "texels at a place";

/// The place is relative to the texture's width and height, as textures may differ in size.
const SHADER: &str = "
@group(0) @binding(0) var values: texture_2d<f32>;
@group(0) @binding(1) var<uniform> place: vec4<f32>;

@fragment fn fragment() -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(values));
    let texel = vec2<i32>(place.xy * vec2<f32>(size));
    return textureLoad(values, clamp(texel, vec2(0), size - 1), 0);
}
";

/// Reads one texel from each of several textures, of any formats and sizes.
pub struct TexelPicker {
    shader: PictureShader,
    pipeline: wgpu::RenderPipeline,
    readback: Readback,
}

impl TexelPicker {
    pub fn new(gpu: &Gpu) -> Self {
        let shader = PictureShader::with_uniform(gpu, LABEL, SHADER);
        Self { pipeline: shader.pipeline(gpu, texture_format(FORMAT)), shader, readback: Readback::default() }
    }

    /// Returns the texel of each picture at a place, from 0 to 1 across and up: missing components as 0, alpha as 1.
    /// Waits for the device once.
    pub fn pick(&mut self, gpu: &Gpu, views: &[wgpu::TextureView], at: [f32; 2]) -> Result<Vec<[f32; 4]>, GpuError> {
        if views.is_empty() {
            return Ok(Vec::new());
        }
        self.shader.set(gpu, [at[0], at[1], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let row = Texture::new(
            gpu,
            &TextureDescriptor {
                label: LABEL,
                shape: TextureShape::flat(views.len() as u32, 1, FORMAT),
                is_target: true,
            },
        )?;
        let bound: Vec<_> = views.iter().map(|view| self.shader.bind(gpu, view)).collect();
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some(LABEL) };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let target = row.attachment(wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT));
        self.shader.draw_parts(gpu, &mut encoder, &self.pipeline, target, |pass| {
            for (index, bound) in bound.iter().enumerate() {
                pass.set_bind_group(0, bound, &[]);
                // The triangle covers the whole target: the scissor rectangle restricts it to this texel.
                pass.set_scissor_rect(index as u32, 0, 1, 1);
                pass.draw(0..3, 0..1);
            }
        });
        gpu.queue.submit([encoder.finish()]);
        self.readback.rgba32float(gpu, &row)
    }
}
