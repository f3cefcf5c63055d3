//! Mip chains, level by level: each texel is the bilinear read of the finer level at its centre, as by GL drivers'
//! `glGenerateMipmap`. The filter is part of the shader, so it also works where 32-bit floats cannot be filtered.

use super::{Gpu, GpuError, Texture, faces::BoundFace, full_screen::PictureShader};
use std::collections::HashMap;

const SHADER: &str = "
@group(0) @binding(0) var finer: texture_2d<f32>;

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(finer));
    let coarse = max(size / 2, vec2(1));
    let centre = position.xy * vec2<f32>(size) / vec2<f32>(coarse) - 0.5;
    let low = vec2<i32>(floor(centre));
    let weight = centre - vec2<f32>(low);
    let last = size - 1;
    let a = clamp(low, vec2(0), last);
    let b = clamp(low + 1, vec2(0), last);
    let bottom = mix(textureLoad(finer, a, 0), textureLoad(finer, vec2(b.x, a.y), 0), weight.x);
    let top = mix(textureLoad(finer, vec2(a.x, b.y), 0), textureLoad(finer, b, 0), weight.x);
    return mix(bottom, top, weight.y);
}
";

/// Builds mip chains of colour formats. One per engine.
pub struct MipMaker {
    shader: PictureShader,
    pipelines: HashMap<wgpu::TextureFormat, wgpu::RenderPipeline>,
}

/// The draws that fill one texture's chain: views and bind groups, created once.
pub struct MipChain {
    steps: Vec<Step>,
    format: wgpu::TextureFormat,
}

/// The draw of one level.
struct Step {
    level: wgpu::TextureView,
    finer: wgpu::BindGroup,
    /// The finer level, and the flat texture that it is drawn into first, where it has no view of its own.
    flattened: Option<(BoundFace, Texture)>,
}

impl MipMaker {
    pub fn new(gpu: &Gpu) -> Self {
        Self { shader: PictureShader::new(gpu, "mips", SHADER), pipelines: HashMap::new() }
    }

    /// Prepares the chain of a texture; for a cube, one per face. Levels of a volume are written instead: see
    /// [`Texture::write_level`].
    pub fn chain(&mut self, gpu: &Gpu, texture: &Texture) -> Result<MipChain, GpuError> {
        let format = texture.raw.format();
        self.pipelines.entry(format).or_insert_with(|| self.shader.pipeline(gpu, format));
        let view = |layer, level| texture.level("mip level", layer, level);
        let mut steps = Vec::new();
        for level in 1..texture.shape.levels {
            // The layers share it, one after the other.
            let mut flat = None;
            for layer in 0..texture.shape.layers() {
                let flattened = match texture.bound_face(gpu, layer, level - 1) {
                    Some(bound) if flat.is_none() => {
                        Some((bound, flat.insert(texture.flat_level(gpu, level - 1)?).clone()))
                    }
                    bound => bound.zip(flat.clone()),
                };
                let finer = match &flattened {
                    Some((_, flat)) => self.shader.bind(gpu, &flat.level_0),
                    None => self.shader.bind(gpu, &view(layer, level - 1)),
                };
                steps.push(Step { level: view(layer, level), finer, flattened });
            }
        }
        Ok(MipChain { steps, format })
    }

    /// Encodes the draws that rebuild every level from level 0.
    pub fn build(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, chain: &MipChain) {
        for Step { level, finer, flattened } in &chain.steps {
            if let Some((face, flat)) = flattened {
                face.draw(gpu, encoder, &flat.level_0, (flat.width(), flat.height()));
            }
            let target = wgpu::RenderPassColorAttachment {
                view: level,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: gpu.load_op_dont_care(), store: wgpu::StoreOp::Store },
            };
            self.shader.draw(gpu, encoder, &self.pipelines[&chain.format], finer, target);
        }
    }
}
