//! Targets of unsigned integers, four to a texel, that are drawn and read back in bands of rows.

use super::{Gpu, GpuError};

/// The format of a target.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// The bytes of a texel.
const TEXEL: u32 = 16;

/// Targets of one size into which a program writes counters, four to a target.
pub struct CounterTargets {
    targets: Vec<(wgpu::Texture, wgpu::TextureView)>,
    size: (u32, u32),
}

impl CounterTargets {
    /// Returns the most targets of this kind that the device lets a program draw into at once.
    pub fn most(gpu: &Gpu) -> usize {
        let limits = gpu.device.limits();
        (limits.max_color_attachment_bytes_per_sample / TEXEL).min(limits.max_color_attachments).max(1) as usize
    }

    /// Returns the formats of a pipeline that draws into this number of them; see
    /// [`FragmentPipelineDescriptor`](super::FragmentPipelineDescriptor).
    pub fn formats(count: usize) -> Vec<(wgpu::TextureFormat, bool)> {
        vec![(FORMAT, true); count]
    }

    /// Creates targets. Returns an error for a size that no target can have, and if memory is exhausted.
    pub fn new(gpu: &Gpu, count: usize, (width, height): (u32, u32)) -> Result<Self, GpuError> {
        gpu.check_size("counters", width, height)?;
        let target = || {
            gpu.guarded("counters", || {
                let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                    label: Some("counters"),
                    size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: wgpu::TextureDimension::D2,
                    format: FORMAT,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                    view_formats: &[],
                });
                let view = texture.create_view(&Default::default());
                (texture, view)
            })
        };
        let targets = (0..count).map(|_| target()).collect::<Result<_, _>>()?;
        Ok(Self { targets, size: (width, height) })
    }

    /// Returns the first targets as attachments, which start as zeros.
    pub fn attachments(&self, count: usize) -> Vec<Option<wgpu::RenderPassColorAttachment<'_>>> {
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store };
        let attachment = |view| wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops };
        let first = self.targets.iter().take(count);
        first.map(|(_, view)| Some(attachment(view))).collect()
    }

    /// Reads `rows` rows of the first `count` targets from row `first` on, target by target and row by row. Waits for
    /// the device.
    pub fn read(&self, gpu: &Gpu, count: usize, first: u32, rows: u32) -> Result<Vec<Vec<[u32; 4]>>, GpuError> {
        let row = self.size.0 * TEXEL;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(padded) * u64::from(rows);
        let buffer = gpu.guarded("counters", || {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("counters"),
                size: bytes * count as u64,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        })?;
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("counters") });
        for (n, (texture, _)) in self.targets.iter().take(count).enumerate() {
            encoder.copy_texture_to_buffer(
                wgpu::TexelCopyTextureInfo {
                    origin: wgpu::Origin3d { x: 0, y: first, z: 0 },
                    ..texture.as_image_copy()
                },
                wgpu::TexelCopyBufferInfo {
                    buffer: &buffer,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: n as u64 * bytes,
                        bytes_per_row: Some(padded),
                        rows_per_image: None,
                    },
                },
                wgpu::Extent3d { width: self.size.0, height: rows, depth_or_array_layers: 1 },
            );
        }
        gpu.queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        gpu.wait()?;
        let mapped = buffer.slice(..).get_mapped_range().map_err(|e| GpuError::Lost(e.to_string()))?;
        let lines = |target: &[u8]| -> Vec<[u32; 4]> {
            let texels = target.chunks_exact(padded as usize).flat_map(|line| line[..row as usize].chunks_exact(16));
            texels.map(bytemuck::pod_read_unaligned).collect()
        };
        Ok(mapped.chunks_exact(bytes as usize).map(lines).collect())
    }
}
