//! Conversion of any colour format to 32-bit floats, texel for texel, for reading back.

use super::{Gpu, GpuError, Texture, TextureDescriptor, full_screen::PictureShader, texture_format};
use eddy_texture::{TexelFormat, TextureShape};

const FORMAT: TexelFormat = TexelFormat::Rgba32f;

const SHADER: &str = "
@group(0) @binding(0) var picture: texture_2d<f32>;

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(picture, vec2<i32>(position.xy), 0);
}
";

/// Copies textures of any format to floats. Created once, as creating a pipeline takes far longer than drawing with it.
pub struct FloatConverter {
    shader: PictureShader,
    pipeline: wgpu::RenderPipeline,
}

impl FloatConverter {
    pub fn new(gpu: &Gpu) -> Self {
        let shader = PictureShader::new(gpu, "as floats", SHADER);
        Self { pipeline: shader.pipeline(gpu, texture_format(FORMAT)), shader }
    }

    /// Converts level 0 of a texture to a new rgba32float texture: the values that a shader reads, missing components
    /// as 0, alpha as 1.
    pub fn convert(&self, gpu: &Gpu, picture: &Texture) -> Result<Texture, GpuError> {
        self.convert_level(gpu, picture, (0, 0))
    }

    /// Does the same as [`FloatConverter::convert`] for any layer and level of a texture.
    pub fn convert_level(&self, gpu: &Gpu, picture: &Texture, (layer, level): (u32, u32)) -> Result<Texture, GpuError> {
        let side = |texels: u32| (texels >> level).max(1);
        let (width, height) = (side(picture.width()), side(picture.height()));
        let descriptor =
            TextureDescriptor { label: "as floats", shape: TextureShape::flat(width, height, FORMAT), is_target: true };
        let floats = Texture::new(gpu, &descriptor)?;
        let read = self.shader.bind(gpu, &picture.readable(gpu, layer, level)?);
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("as floats") });
        let target = floats.attachment(wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT));
        self.shader.draw(gpu, &mut encoder, &self.pipeline, &read, target);
        gpu.queue.submit([encoder.finish()]);
        Ok(floats)
    }
}
