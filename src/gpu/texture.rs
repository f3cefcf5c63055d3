//! Two-dimensional textures with the views a multipass renderer needs.

use super::{Gpu, GpuError};

/// Levels of a whole mip chain: floor(log2(longest side)) + 1.
pub fn mip_levels(width: u32, height: u32) -> u32 {
    width.max(height).max(1).ilog2() + 1
}

/// The texture that is to be made.
#[derive(Clone, Copy, Debug)]
pub struct TextureDescriptor<'a> {
    pub label: &'a str,
    pub width: u32,
    pub height: u32,
    pub format: wgpu::TextureFormat,
    /// Levels of the mip chain, at least 1.
    pub levels: u32,
    /// Passes draw into it. Mips and readback need this too.
    pub is_target: bool,
}

/// A 2D texture. Its texels start as zeros.
#[derive(Clone, Debug)]
pub struct Texture {
    pub raw: wgpu::Texture,
    /// Every level: what shaders read.
    pub all_levels: wgpu::TextureView,
    /// Level 0 alone: what passes draw into.
    pub level_0: wgpu::TextureView,
}

impl Texture {
    /// Makes a texture; an error for a size no target can have and for memory that is not there.
    pub fn new(gpu: &Gpu, descriptor: &TextureDescriptor<'_>) -> Result<Texture, GpuError> {
        let TextureDescriptor { label, width, height, format, levels, is_target } = *descriptor;
        gpu.check_size(label, width, height)?;
        let mut usage =
            wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::COPY_DST;
        if is_target || levels > 1 {
            usage |= wgpu::TextureUsages::RENDER_ATTACHMENT;
        }
        let raw = gpu.guarded(label, || {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: levels,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        })?;
        let level_0 = raw.create_view(&wgpu::TextureViewDescriptor {
            label: Some(label),
            mip_level_count: Some(1),
            ..Default::default()
        });
        let all_levels = raw.create_view(&wgpu::TextureViewDescriptor { label: Some(label), ..Default::default() });
        Ok(Texture { raw, all_levels, level_0 })
    }

    /// Returns level 0 as a pass draws into it and keeps it.
    pub fn attachment(&self, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
        wgpu::RenderPassColorAttachment {
            view: &self.level_0,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        }
    }

    pub fn width(&self) -> u32 {
        self.raw.width()
    }

    pub fn height(&self) -> u32 {
        self.raw.height()
    }

    pub fn levels(&self) -> u32 {
        self.raw.mip_level_count()
    }

    /// Writes level 0. `bytes` holds the rows without padding, row 0 first.
    pub fn write(&self, gpu: &Gpu, bytes: &[u8]) {
        let texel = self.raw.format().block_copy_size(None).unwrap_or(4);
        gpu.queue.write_texture(
            self.raw.as_image_copy(),
            bytes,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(self.width() * texel), rows_per_image: None },
            wgpu::Extent3d { width: self.width(), height: self.height(), depth_or_array_layers: 1 },
        );
    }

    /// Writes one texel of level 0. `bytes`: as many as a texel of the format has.
    pub fn write_texel(&self, gpu: &Gpu, (x, y): (u32, u32), bytes: &[u8]) {
        let mut place = self.raw.as_image_copy();
        place.origin = wgpu::Origin3d { x, y, z: 0 };
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: None, rows_per_image: None };
        let one = wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 };
        gpu.queue.write_texture(place, bytes, layout, one);
    }

    /// Copies the overlap of two textures of one format, texel for texel from row 0, column 0.
    pub fn copy_overlap(&self, encoder: &mut wgpu::CommandEncoder, to: &Texture) {
        let size = wgpu::Extent3d {
            width: self.width().min(to.width()),
            height: self.height().min(to.height()),
            depth_or_array_layers: 1,
        };
        encoder.copy_texture_to_texture(self.raw.as_image_copy(), to.raw.as_image_copy(), size);
    }

    /// Sets all texels of level 0. The texture must be a target.
    pub fn clear(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, color: wgpu::Color) {
        gpu.pass(
            encoder,
            wgpu::RenderPassDescriptor {
                label: Some("clear"),
                color_attachments: &[Some(self.attachment(wgpu::LoadOp::Clear(color)))],
                ..Default::default()
            },
            |_| (),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::mip_levels;

    #[test]
    fn a_chain_goes_down_to_one_texel() {
        assert_eq!([(1, 1), (2, 1), (3, 3), (1, 4096), (1920, 1080)].map(|(w, h)| mip_levels(w, h)), [1, 2, 2, 13, 11]);
    }
}
