//! What a pass sees in one frame that is no texture: the site's uniforms and the author's own.

use super::{
    FrameInputs,
    bind::UNIFORM_STRIDE,
    program::{BoundChannel, CompiledDraw},
};
use crate::{
    glsl::{
        UniformSet,
        interface::{GeometryBlock, KNOB_BYTES, UniformBlock},
    },
    gpu::Gpu,
};
use bytemuck::Zeroable;

/// Blocks of meshes lie this far apart, which is what every device allows.
pub(super) const GEOMETRY_STRIDE: u64 = 256;

/// All passes' uniform blocks in one buffer, written once a frame.
pub(super) struct Uniforms {
    pub buffer: wgpu::Buffer,
    bytes: Vec<u8>,
    /// The author's own, one block for all passes, written when one changes.
    pub knobs: wgpu::Buffer,
    pub knob_slots: Vec<[u32; 4]>,
    /// What meshes are drawn with, a block for each program of each pass.
    pub geometry: wgpu::Buffer,
    geometry_bytes: Vec<u8>,
}

impl Uniforms {
    pub fn new(gpu: &Gpu, passes: usize, knobs: usize, meshes: usize) -> Self {
        let make = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let bytes = vec![0; passes.max(1) * UNIFORM_STRIDE as usize];
        let buffer = make("uniforms", bytes.len() as u64);
        let own = make("own uniforms", knobs.max(1) as u64 * KNOB_BYTES);
        // As a new buffer is.
        let geometry_bytes = vec![0; meshes.max(1) * GEOMETRY_STRIDE as usize];
        let geometry = make("geometry", geometry_bytes.len() as u64);
        Self { buffer, bytes, knobs: own, knob_slots: vec![[0; 4]; knobs], geometry, geometry_bytes }
    }

    pub fn set(&mut self, draw: usize, block: &UniformBlock) {
        let at = draw * UNIFORM_STRIDE as usize;
        self.bytes[at..at + size_of::<UniformBlock>()].copy_from_slice(bytemuck::bytes_of(block));
    }

    pub fn get(&self, draw: usize) -> UniformBlock {
        let at = draw * UNIFORM_STRIDE as usize;
        bytemuck::pod_read_unaligned(&self.bytes[at..at + size_of::<UniformBlock>()])
    }

    pub fn write(&self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.buffer, 0, &self.bytes);
        gpu.queue.write_buffer(&self.geometry, 0, &self.geometry_bytes);
    }

    /// The block of a mesh, counted through all passes.
    pub fn set_geometry(&mut self, mesh: usize, block: &GeometryBlock) {
        let at = mesh * GEOMETRY_STRIDE as usize;
        self.geometry_bytes[at..at + size_of::<GeometryBlock>()].copy_from_slice(bytemuck::bytes_of(block));
    }

    /// What draw `index` reads of all this, and nothing else: equal bytes, equal values.
    pub fn seen_by(&self, index: usize, draw: &CompiledDraw) -> Vec<u8> {
        let mut seen = bytemuck::bytes_of(&masked(&self.get(index), draw.uniforms)).to_vec();
        for slot in draw.knobs.iter() {
            seen.extend_from_slice(bytemuck::cast_slice(&self.knob_slots[usize::from(slot)]));
        }
        if let Some(boundary) = &draw.boundary {
            seen.extend(self.seen_by(index, &boundary.compiled));
        }
        if draw.reads_geometry {
            let begin = draw.first_mesh * GEOMETRY_STRIDE as usize;
            seen.extend_from_slice(&self.geometry_bytes[begin..][..draw.programs.len() * GEOMETRY_STRIDE as usize]);
        }
        seen
    }
}

/// The block of a pass of size `own`, on a canvas.
pub(super) fn block(
    inputs: &FrameInputs,
    own: (u32, u32),
    canvas: (u32, u32),
    channels: &[BoundChannel; 4],
) -> UniformBlock {
    let vec3 = |(width, height): (u32, u32)| [width as f32, height as f32, 1.0];
    let resolution = |c: &BoundChannel| c.buffer.map_or(c.resolution, |size| vec3(size.of(canvas)));
    UniformBlock {
        resolution: vec3(own),
        time: inputs.time_secs as f32,
        mouse: inputs.mouse,
        date: inputs.date,
        time_delta: inputs.time_delta_secs,
        frame_rate: inputs.frame_rate,
        sample_rate: 44100.0,
        frame: inputs.frame,
        channel_time: [[0.0; 4]; 4],
        channel_resolution: std::array::from_fn(|i| {
            let [x, y, z] = resolution(&channels[i]);
            [x, y, z, 0.0]
        }),
        time_offset: 0.0,
        sample_offset: 0,
        pad: [0; 2],
        channel_loaded: std::array::from_fn(|i| i32::from(resolution(&channels[i])[0] > 0.0)),
    }
}

/// The block with zeros in place of what is not read.
fn masked(block: &UniformBlock, read: UniformSet) -> UniformBlock {
    let mut out = UniformBlock::zeroed();
    macro_rules! keep {
        ($($name:ident $field:ident;)*) => {
            $(if read.contains(UniformSet::$name) {
                out.$field = block.$field;
            })*
        };
    }
    keep! {
        RESOLUTION resolution;
        TIME time;
        MOUSE mouse;
        DATE date;
        TIME_DELTA time_delta;
        FRAME_RATE frame_rate;
        SAMPLE_RATE sample_rate;
        FRAME frame;
        CHANNEL_TIME channel_time;
        CHANNEL_RESOLUTION channel_resolution;
        TIME_OFFSET time_offset;
        SAMPLE_OFFSET sample_offset;
        CHANNEL_LOADED channel_loaded;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_uniform_that_is_read_is_seen() {
        let full: UniformBlock = bytemuck::pod_read_unaligned(&[1u8; size_of::<UniformBlock>()]);
        let mut all = UniformSet::EMPTY;
        for bit in 0..16 {
            // Each uniform by itself shows in the bytes, and none shows unasked.
            let name = UniformSet::from_bit(bit);
            if name.names().is_empty() {
                continue;
            }
            assert_ne!(masked(&full, name), UniformBlock::zeroed(), "{:?}", name.names());
            all.insert(name);
        }
        assert_eq!(masked(&full, UniformSet::EMPTY), UniformBlock::zeroed());
        assert_eq!(masked(&full, all), UniformBlock { pad: [0; 2], ..full });
    }
}
