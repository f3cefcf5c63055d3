//! Reading texels back from the device.

use super::{Gpu, GpuError, Texture};

/// Reads textures back. The staging buffer is kept for the next texture of that size.
#[derive(Default)]
pub struct Readback {
    buffer: Option<wgpu::Buffer>,
}

impl Readback {
    /// Reads level 0 of an rgba32float texture, rows in texture order without padding. Waits for the device.
    pub fn rgba32float(&mut self, gpu: &Gpu, texture: &Texture) -> Result<Vec<[f32; 4]>, GpuError> {
        let mut texels = Vec::with_capacity(texture.width() as usize * texture.height() as usize);
        self.rows(gpu, texture, (0, 16), |row| {
            texels.extend(row.chunks_exact(16).map(bytemuck::pod_read_unaligned::<[f32; 4]>));
        })?;
        Ok(texels)
    }

    /// Reads level 0 of an rgba8unorm texture in the same way.
    pub fn rgba8(&mut self, gpu: &Gpu, texture: &Texture) -> Result<Vec<u8>, GpuError> {
        let mut bytes = Vec::with_capacity(texture.width() as usize * texture.height() as usize * 4);
        self.rows(gpu, texture, (0, 4), |row| bytes.extend_from_slice(row))?;
        Ok(bytes)
    }

    /// Reads level 0 of all layers of a texture in its own format: the bytes that [`Texture::write`] takes.
    pub fn bytes(&mut self, gpu: &Gpu, texture: &Texture) -> Result<Vec<u8>, GpuError> {
        let shape = texture.shape.without_mips();
        let mut bytes = Vec::with_capacity(shape.bytes() as usize);
        for layer in 0..shape.depth * shape.layers() {
            let flat = texture.flat_copy(gpu, layer, 0)?;
            let (texture, layer) = flat.as_ref().map_or((texture, layer), |flat| (flat, 0));
            self.rows(gpu, texture, (layer, shape.format.bytes() as usize), |row| bytes.extend_from_slice(row))?;
        }
        Ok(bytes)
    }

    /// Passes each row of a layer to a callback; texels have this many bytes.
    fn rows(
        &mut self,
        gpu: &Gpu,
        texture: &Texture,
        (layer, texel): (u32, usize),
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), GpuError> {
        let (width, height) = (texture.width(), texture.height());
        let row = width as usize * texel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        let size = (padded * height as usize) as u64;
        let limit = gpu.device.limits().max_buffer_size;
        if size > limit {
            let what = format!("reading back {width}x{height} texels ({size} bytes of {limit})");
            return Err(GpuError::OutOfMemory(what));
        }
        // It is stored again on success; a buffer whose mapping failed is not reused.
        let buffer = match self.buffer.take().filter(|buffer| buffer.size() == size) {
            Some(buffer) => buffer,
            None => gpu.guarded("readback", || {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("readback"),
                    size,
                    usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                    mapped_at_creation: false,
                })
            })?,
        };
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("readback") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded as u32), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
                ..texture.raw.as_image_copy()
            },
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        gpu.wait()?;
        {
            let mapped = buffer.slice(..).get_mapped_range().map_err(|e| GpuError::Lost(e.to_string()))?;
            mapped.chunks_exact(padded).for_each(|line| take(&line[..row]));
        }
        buffer.unmap();
        self.buffer = Some(buffer);
        Ok(())
    }
}
