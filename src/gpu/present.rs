//! Conversion of a float picture whose row 0 is the bottom to 8 bits with row 0 at the top, for a window.

use super::{Gpu, GpuError, Texture, TextureDescriptor, full_screen::PictureShader, texture_format};
use eddy_texture::{TexelFormat, TextureShape};

const SHADER: &str = "
@group(0) @binding(0) var picture: texture_2d<f32>;

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(picture));
    let texel = vec2<i32>(position.xy);
    let colour = textureLoad(picture, vec2(texel.x, size.y - 1 - texel.y), 0).rgb;
    // NaN shows as 0, as in every saved picture; a comparison with it is false.
    let bits = bitcast<vec3<u32>>(colour) & vec3(0x7fffffffu);
    return vec4(select(clamp(colour, vec3(0.0), vec3(1.0)), vec3(0.0), bits > vec3(0x7f800000u)), 1.0);
}
";

const FORMAT: TexelFormat = TexelFormat::Rgba8;

/// Draws pictures into a display texture (rgba8unorm).
pub struct Presenter {
    shader: PictureShader,
    pipeline: wgpu::RenderPipeline,
}

impl Presenter {
    pub fn new(gpu: &Gpu) -> Self {
        let shader = PictureShader::new(gpu, "present", SHADER);
        Self { pipeline: shader.pipeline(gpu, texture_format(FORMAT)), shader }
    }

    /// Returns a display texture of the given size, opaque and black, so that nothing shines through before the first
    /// picture.
    pub fn texture(gpu: &Gpu, width: u32, height: u32) -> Result<Texture, GpuError> {
        let descriptor =
            TextureDescriptor { label: "display", shape: TextureShape::flat(width, height, FORMAT), is_target: true };
        let texture = Texture::new(gpu, &descriptor)?;
        texture.write(gpu, &[0, 0, 0, 255].repeat(width as usize * height as usize));
        Ok(texture)
    }

    /// Creates the bind group with which [`Presenter::present`] shows one picture repeatedly.
    pub fn bind(&self, gpu: &Gpu, picture: &Texture) -> wgpu::BindGroup {
        self.shader.bind(gpu, &picture.level_0)
    }

    /// Draws the picture into `display`, which must have the same size.
    pub fn present(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, picture: &wgpu::BindGroup, display: &Texture) {
        let target = display.attachment(gpu.load_op_dont_care());
        self.shader.draw(gpu, encoder, &self.pipeline, picture, target);
    }
}
