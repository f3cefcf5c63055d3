//! The parts that every program draws with: the device, samplers, the keyboard, and textures for channels that have
//! none.

use eddy_gpu::{Gpu, GpuError, MipMaker, Samplers, Texture, TextureDescriptor};
use eddy_media::Keyboard;

pub(super) struct Shared {
    pub gpu: Gpu,
    pub samplers: Samplers,
    pub fallbacks: FallbackTextures,
    pub keyboard: KeyboardTexture,
    pub mips: MipMaker,
}

impl Shared {
    pub fn new(gpu: Gpu) -> Result<Self, GpuError> {
        Ok(Self {
            samplers: Samplers::new(&gpu),
            fallbacks: FallbackTextures::new(&gpu)?,
            keyboard: KeyboardTexture::new(&gpu)?,
            mips: MipMaker::new(&gpu),
            gpu,
        })
    }
}

/// One opaque black texel in each dimension: what a channel with nothing in it reads, as OpenGL ES 3.0 has it for an
/// incomplete texture (section 3.8.13). A buffer without a pass is no such channel: it is there, and its texels are zeros.
pub(super) struct FallbackTextures {
    pub flat: wgpu::TextureView,
    pub volume: wgpu::TextureView,
    pub cube: wgpu::TextureView,
}

const OPAQUE_BLACK: [u8; 4] = [0, 0, 0, 255];

impl FallbackTextures {
    fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let view = |dimension, layers, view_dimension| {
            let size = wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: layers };
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("fallback"),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension,
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            let texels = OPAQUE_BLACK.repeat(layers as usize);
            let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4), rows_per_image: Some(1) };
            gpu.queue.write_texture(texture.as_image_copy(), &texels, rows, size);
            texture.create_view(&wgpu::TextureViewDescriptor { dimension: Some(view_dimension), ..Default::default() })
        };
        Ok(Self {
            flat: view(wgpu::TextureDimension::D2, 1, wgpu::TextureViewDimension::D2),
            volume: view(wgpu::TextureDimension::D3, 1, wgpu::TextureViewDimension::D3),
            cube: view(wgpu::TextureDimension::D2, 6, wgpu::TextureViewDimension::Cube),
        })
    }
}

/// The keyboard as a texture, 256 x 3 texels.
pub(super) struct KeyboardTexture {
    pub texture: Texture,
    shown: Vec<u8>,
    /// Number of times that it has changed.
    pub changes: u64,
}

impl KeyboardTexture {
    fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let format = wgpu::TextureFormat::R8Unorm;
        let descriptor =
            TextureDescriptor { label: "keyboard", width: 256, height: 3, format, levels: 1, is_target: false };
        Ok(Self { texture: Texture::new(gpu, &descriptor)?, shown: Vec::new(), changes: 0 })
    }

    /// Writes the keys of a frame if they are other than before.
    pub fn show(&mut self, gpu: &Gpu, keyboard: &Keyboard) {
        if self.shown != keyboard.bytes() {
            self.texture.write(gpu, keyboard.bytes());
            self.shown = keyboard.bytes().to_vec();
            self.changes += 1;
        }
    }
}
