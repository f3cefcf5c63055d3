//! Thumbnails of float textures, for panels that show many of them.

use super::{Gpu, GpuError, Texture, TextureDescriptor, full_screen::PictureShader, texture_format};
use eddy_texture::{TexelFormat, TextureShape};

/// The size of each in texels, regardless of the texture's aspect ratio.
pub const SIZE: (u32, u32) = (160, 90);

const FORMAT: TexelFormat = TexelFormat::Rgba8;

/// Each texel averages four texels of its area, so that a row of thin lines is not all light or all dark. Alpha is 0
/// where any texel of the area is NaN or infinite.
fn shader() -> String {
    let (width, height) = SIZE;
    format!(
        "
@group(0) @binding(0) var picture: texture_2d<f32>;

fn has_nonfinite(low: vec2<u32>, high: vec2<u32>) -> bool {{
    let end = min(high, textureDimensions(picture));
    for (var y = low.y; y < end.y; y++) {{
        for (var x = low.x; x < end.x; x++) {{
            let bits = bitcast<vec4<u32>>(textureLoad(picture, vec2(x, y), 0)) & vec4(0x7fffffffu);
            if any(bits >= vec4(0x7f800000u)) {{ return true; }}
        }}
    }}
    return false;
}}

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {{
    let size = vec2<f32>(textureDimensions(picture));
    let cell = size / vec2({width}.0, {height}.0);
    let corner = vec2(position.x - 0.5, {height}.0 - 0.5 - position.y) * cell;
    var sum = vec3(0.0);
    for (var i = 0; i < 4; i++) {{
        let part = vec2(f32(i & 1), f32(i >> 1)) * 0.5 + 0.25;
        let texel = vec2<i32>(clamp(corner + part * cell, vec2(0.0), size - 1.0));
        let colour = textureLoad(picture, texel, 0).rgb;
        // NaN shows as 0, as in every picture; a comparison with it is false.
        let bits = bitcast<vec3<u32>>(colour) & vec3(0x7fffffffu);
        sum += select(clamp(colour, vec3(0.0), vec3(1.0)), vec3(0.0), bits > vec3(0x7f800000u));
    }}
    return vec4(sum / 4.0, select(1.0, 0.0, has_nonfinite(vec2<u32>(corner), vec2<u32>(ceil(corner + cell)))));
}}
"
    )
}

/// Draws thumbnails.
pub struct Miniatures {
    shader: PictureShader,
    pipeline: wgpu::RenderPipeline,
    texture: Texture,
}

impl Miniatures {
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let shader = PictureShader::new(gpu, "miniature", &shader());
        let (width, height) = SIZE;
        let descriptor =
            TextureDescriptor { label: "miniature", shape: TextureShape::flat(width, height, FORMAT), is_target: true };
        Ok(Self {
            pipeline: shader.pipeline(gpu, texture_format(FORMAT)),
            texture: Texture::new(gpu, &descriptor)?,
            shader,
        })
    }

    /// Draws a thumbnail, top row first. The next one replaces it.
    pub fn draw(&self, gpu: &Gpu, picture: &wgpu::TextureView) -> &Texture {
        let bound = self.shader.bind(gpu, picture);
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("miniature") });
        let target = self.texture.attachment(gpu.load_op_dont_care());
        self.shader.draw(gpu, &mut encoder, &self.pipeline, &bound, target);
        gpu.queue.submit([encoder.finish()]);
        &self.texture
    }
}
