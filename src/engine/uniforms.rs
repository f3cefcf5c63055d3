//! The uniforms of the passes in one frame: Shadertoy's, the author's own, and those of meshes.

use super::{
    FrameInputs, host,
    program::{BoundChannel, CompiledDraw, Program},
};
use eddy_glsl::{
    MAX_CHANNELS, UniformSet,
    interface::{CUSTOM_UNIFORM_BYTES, GeometryBlock, UniformBlock},
};
use eddy_gpu::Gpu;
use std::{mem::offset_of, ops::Range};

/// The stride of blocks in their buffers, which every device allows.
const STRIDE: u64 = 256;

const _: () = assert!(size_of::<UniformBlock>() <= STRIDE as usize && size_of::<GeometryBlock>() <= STRIDE as usize);

/// The uniform blocks of all passes, as bytes and in buffers, which are written once per frame.
pub(super) struct Uniforms {
    /// Shadertoy's uniforms, one block per draw; for a cubemap pass one per face.
    blocks: Blocks,
    /// The first block of each draw.
    first: Vec<usize>,
    /// The matrices of meshes, one block per program of each pass.
    meshes: Blocks,
    /// The author's own, one block for all passes, written when a value changes.
    custom_uniforms: wgpu::Buffer,
    custom_uniform_slots: Vec<[u32; 4]>,
    /// The number of slots of the author's own; the following ones belong to the program that the texts are written
    /// for.
    own: usize,
}

/// The uniforms that a draw reads besides custom uniforms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct UniformReads {
    pub uniforms: UniformSet,
    /// It reads matrices of meshes or the camera.
    pub geometry: bool,
}

impl UniformReads {
    /// Returns those that a draw may read whatever the values of custom uniforms.
    pub(crate) fn of(draw: &CompiledDraw) -> Self {
        Self { uniforms: draw.uniforms, geometry: draw.reads_geometry }
    }
}

/// Blocks of one size, [`STRIDE`] apart.
struct Blocks {
    buffer: wgpu::Buffer,
    bytes: Vec<u8>,
}

impl Blocks {
    fn new(gpu: &Gpu, label: &str, count: usize) -> Self {
        // Like a new buffer.
        let bytes = vec![0; count.max(1) * STRIDE as usize];
        Self { buffer: uniform_buffer(gpu, label, bytes.len() as u64), bytes }
    }

    fn block(&self, index: usize) -> &[u8] {
        &self.bytes[index * STRIDE as usize..][..STRIDE as usize]
    }

    fn set(&mut self, index: usize, block: &[u8]) {
        self.bytes[index * STRIDE as usize..][..block.len()].copy_from_slice(block);
    }

    fn binding(&self, index: usize, bytes: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: index as u64 * STRIDE,
            size: std::num::NonZero::new(bytes as u64),
        })
    }
}

fn uniform_buffer(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

impl Uniforms {
    pub(crate) fn new(gpu: &Gpu, program: &Program) -> Self {
        let custom_uniforms = program.custom_uniforms.len() + host::slots(program.dialect);
        let mut count = 0;
        let first = (0..program.draws.len()).map(|draw| {
            count += program.plan.layers(draw) as usize;
            count - program.plan.layers(draw) as usize
        });
        let first: Vec<usize> = first.collect();
        Self {
            blocks: Blocks::new(gpu, "uniforms", count),
            first,
            meshes: Blocks::new(gpu, "geometry", program.meshes()),
            custom_uniforms: uniform_buffer(gpu, "own uniforms", custom_uniforms.max(1) as u64 * CUSTOM_UNIFORM_BYTES),
            own: program.custom_uniforms.len(),
            custom_uniform_slots: vec![[0; 4]; custom_uniforms],
        }
    }

    /// Sets the blocks of draw `index`, one per layer.
    pub(crate) fn set(&mut self, index: usize, layers: u32, block: &UniformBlock) {
        for face in 0..layers {
            let block = UniformBlock { cube_face: [face as i32, 0], ..*block };
            self.blocks.set(self.first[index] + face as usize, bytemuck::bytes_of(&block));
        }
    }

    /// Sets the position of draw `index`'s target in its picture, in pixels.
    pub(crate) fn set_tile_origin(&mut self, index: usize, (x, y): (u32, u32)) {
        let block = UniformBlock { tile_origin: [x as i32, y as i32, 0, 0], ..self.uniform_block(index) };
        self.blocks.set(self.first[index], bytemuck::bytes_of(&block));
    }

    /// Sets the block of a mesh, by its index among all passes.
    pub(crate) fn set_mesh(&mut self, mesh: usize, block: &GeometryBlock) {
        self.meshes.set(mesh, bytemuck::bytes_of(block));
    }

    /// Uploads the blocks to the device.
    pub(crate) fn write(&self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.blocks.buffer, 0, &self.blocks.bytes);
        gpu.queue.write_buffer(&self.meshes.buffer, 0, &self.meshes.bytes);
    }

    /// Sets the author's own uniforms. Returns whether any value has changed.
    pub(crate) fn set_custom_uniforms(&mut self, gpu: &Gpu, slots: Vec<[u32; 4]>) -> bool {
        self.set_slots(gpu, 0, &slots)
    }

    /// Sets the uniforms of the program that the texts are written for.
    pub(crate) fn set_host_uniforms(&mut self, gpu: &Gpu, slots: &[[u32; 4]]) {
        self.set_slots(gpu, self.own, slots);
    }

    fn set_slots(&mut self, gpu: &Gpu, first: usize, slots: &[[u32; 4]]) -> bool {
        let Some(present) = self.custom_uniform_slots.get_mut(first..first + slots.len()) else { return false };
        if slots == present {
            return false;
        }
        present.copy_from_slice(slots);
        gpu.queue.write_buffer(&self.custom_uniforms, first as u64 * CUSTOM_UNIFORM_BYTES, bytemuck::cast_slice(slots));
        true
    }

    pub(crate) fn block_binding(&self, index: usize, layer: u32) -> wgpu::BindingResource<'_> {
        self.blocks.binding(self.first[index] + layer as usize, size_of::<UniformBlock>())
    }

    pub(crate) fn mesh_binding(&self, mesh: usize) -> wgpu::BindingResource<'_> {
        self.meshes.binding(mesh, size_of::<GeometryBlock>())
    }

    pub(crate) fn custom_uniform_binding(&self) -> wgpu::BindingResource<'_> {
        self.custom_uniforms.as_entire_binding()
    }

    /// Shadertoy's uniforms of draw `index`.
    pub(crate) fn uniform_block(&self, index: usize) -> UniformBlock {
        bytemuck::pod_read_unaligned(&self.blocks.block(self.first[index])[..size_of::<UniformBlock>()])
    }

    /// The matrices of a mesh, by its index among all passes.
    pub(crate) fn mesh_block(&self, mesh: usize) -> GeometryBlock {
        bytemuck::pod_read_unaligned(&self.meshes.block(mesh)[..size_of::<GeometryBlock>()])
    }

    /// The words of the author's own, in slot order.
    pub(crate) fn custom_uniforms(&self) -> &[[u32; 4]] {
        &self.custom_uniform_slots
    }

    /// Appends exactly the uniforms that draw `index` reads: equal bytes mean equal values. Of Shadertoy's uniforms and
    /// the matrices of meshes, only those in `reads` are appended.
    pub(crate) fn add_read_by(&self, index: usize, draw: &CompiledDraw, reads: UniformReads, read: &mut Vec<u8>) {
        let block = self.blocks.block(self.first[index]);
        for range in places(reads.uniforms) {
            read.extend_from_slice(&block[range]);
        }
        for &slot in &draw.custom_uniforms {
            read.extend_from_slice(bytemuck::cast_slice(&self.custom_uniform_slots[usize::from(slot)]));
        }
        if let Some(boundary) = &draw.boundary {
            self.add_read_by(index, &boundary.compiled, UniformReads::of(&boundary.compiled), read);
        }
        if reads.geometry {
            draw.body.geometry_blocks().for_each(|block| read.extend_from_slice(self.meshes.block(block)));
        }
    }
}

/// Returns the block of a pass of size `own` on a canvas.
pub(super) fn block(
    inputs: &FrameInputs,
    own: (u32, u32),
    canvas: (u32, u32),
    channels: &[BoundChannel; MAX_CHANNELS],
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
        channel_time: std::array::from_fn(|i| [channels[i].clock.at(inputs), 0.0, 0.0, 0.0]),
        channel_resolution: std::array::from_fn(|i| {
            let [x, y, z] = resolution(&channels[i]);
            [x, y, z, 0.0]
        }),
        time_offset: 0.0,
        sample_offset: 0,
        cube_face: [0; 2],
        channel_loaded: std::array::from_fn(|i| i32::from(resolution(&channels[i])[0] > 0.0)),
        tile_origin: [0; 4],
    }
}

/// Returns the byte ranges in a block of the uniforms of a set.
fn places(read: UniformSet) -> impl Iterator<Item = Range<usize>> {
    /// Builds the byte ranges of fields from the sizes of their types.
    macro_rules! places {
        ($($name:ident $field:ident;)*) => {
            [$((UniformSet::$name, offset_of!(UniformBlock, $field), size_of_field(|b| &b.$field))),*]
        };
    }
    let all = places! {
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
    };
    all.into_iter().filter(move |(name, ..)| read.contains(*name)).map(|(_, start, size)| start..start + size)
}

fn size_of_field<T>(_: fn(&UniformBlock) -> &T) -> usize {
    size_of::<T>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniforms_have_disjoint_ranges_that_cover_the_block() {
        let mut taken = [0u8; size_of::<UniformBlock>()];
        for name in UniformSet::all().iter() {
            let places: Vec<_> = places(name).collect();
            assert_eq!(places.len(), 1, "{name:?}");
            places.into_iter().flatten().for_each(|byte| taken[byte] += 1);
        }
        let (face, origin) = (offset_of!(UniformBlock, cube_face), offset_of!(UniformBlock, tile_origin));
        let is_none = |byte: usize| (face..face + 8).contains(&byte) || (origin..origin + 16).contains(&byte);
        for (byte, taken) in taken.into_iter().enumerate() {
            assert_eq!(taken, u8::from(!is_none(byte)), "byte {byte}");
        }
        assert_eq!(places(UniformSet::empty()).count(), 0);
    }
}
