//! Texels back from the device.

use super::{Gpu, GpuError, Texture};

/// Reads level 0 of an rgba32float texture, rows in texture order without padding. Waits for the device.
pub fn read_rgba32float(gpu: &Gpu, texture: &Texture) -> Result<Vec<[f32; 4]>, GpuError> {
    let (width, height) = (texture.width(), texture.height());
    let row = width as usize * 16;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
    let size = (padded * height as usize) as u64;
    let limit = gpu.device.limits().max_buffer_size;
    if size > limit {
        return Err(GpuError::OutOfMemory(format!("reading back {width}x{height} texels ({size} bytes of {limit})")));
    }
    let buffer = gpu.guarded("readback", || {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        })
    })?;
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
    encoder.copy_texture_to_buffer(
        texture.raw.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded as u32), rows_per_image: None },
        },
        wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
    );
    gpu.queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
    gpu.wait()?;
    let mapped = buffer.slice(..).get_mapped_range().map_err(|e| GpuError::Lost(e.to_string()))?;
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for line in mapped.chunks_exact(padded) {
        texels.extend(line[..row].chunks_exact(16).map(bytemuck::pod_read_unaligned::<[f32; 4]>));
    }
    Ok(texels)
}
