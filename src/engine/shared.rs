//! The resources that all programs share: the device, samplers, and textures for empty channels.

use eddy_gpu::{Gpu, GpuError, MipMaker, Samplers, Texture, TextureDescriptor};
use eddy_texture::{Dimension, TexelFormat, TextureShape};
use std::sync::{Arc, atomic::AtomicBool};

pub(super) struct Shared {
    pub gpu: Gpu,
    pub samplers: Samplers,
    pub fallbacks: FallbackTextures,
    pub mips: MipMaker,
    /// Set by another thread to end a frame between two slices.
    pub stop: Arc<AtomicBool>,
}

impl Shared {
    pub(crate) fn new(gpu: Gpu) -> Result<Self, GpuError> {
        Ok(Self {
            samplers: Samplers::new(&gpu),
            fallbacks: FallbackTextures::new(&gpu)?,
            mips: MipMaker::new(&gpu),
            stop: Arc::default(),
            gpu,
        })
    }
}

/// One opaque black texel in each dimension, which an empty channel reads, as OpenGL ES 3.0 defines for an incomplete
/// texture (section 3.8.13). A missing buffer is not such a channel: its texels exist and are zeros.
pub(super) struct FallbackTextures {
    flat: Texture,
    volume: Texture,
    cube: Texture,
}

const OPAQUE_BLACK: [u8; 4] = [0, 0, 0, 255];

impl FallbackTextures {
    fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let texture = |shape: TextureShape| {
            let texture = Texture::new(gpu, &TextureDescriptor { label: "fallback", shape, is_target: false })?;
            texture.write(gpu, &OPAQUE_BLACK.repeat(shape.layers() as usize));
            Ok(texture)
        };
        Ok(Self {
            flat: texture(TextureShape::flat(1, 1, TexelFormat::Rgba8))?,
            volume: texture(TextureShape::volume(1, 1, 1, TexelFormat::Rgba8))?,
            cube: texture(TextureShape::cube(1, TexelFormat::Rgba8))?,
        })
    }

    pub(crate) fn of(&self, dimension: Dimension) -> &wgpu::TextureView {
        match dimension {
            Dimension::D2 => &self.flat.all_levels,
            Dimension::D3 => &self.volume.all_levels,
            Dimension::Cube => &self.cube.all_levels,
        }
    }
}
