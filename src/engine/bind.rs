//! Bind groups: which textures the channels of each draw see. Made when first needed and kept for a program and a size, so
//! that a frame only sets them.

use super::{
    program::{BoundChannel, CompiledDraw, Program},
    targets::Target,
    uniforms::{GEOMETRY_STRIDE, Uniforms},
};
use crate::{
    glsl::{
        ChannelKind,
        interface::{self, GeometryBlock, UniformBlock},
    },
    gpu::{Address, Filtering, Gpu, Samplers, Texture},
    graph::{Draw, Read, Source},
    project::{Filter, Wrap},
};

/// Uniform blocks lie this far apart in the one buffer, which is what every device allows.
pub(super) const UNIFORM_STRIDE: u64 = 256;

/// Textures that channels read besides targets and pictures.
pub(super) struct Stock {
    pub samplers: Samplers,
    pub keyboard: Texture,
    /// Black and without alpha; what a channel with nothing in it reads.
    nothing_2d: Texture,
    nothing_3d: wgpu::TextureView,
    nothing_cube: wgpu::TextureView,
}

impl Stock {
    pub fn new(gpu: &Gpu) -> Result<Self, crate::gpu::GpuError> {
        let picture = |label, width, height, format| {
            Texture::new(
                gpu,
                &crate::gpu::TextureDescriptor { label, width, height, format, levels: 1, is_target: false },
            )
        };
        let view = |dimension, layers, view_dimension| {
            gpu.device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some("nothing"),
                    size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: layers },
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension,
                    format: wgpu::TextureFormat::Rgba8Unorm,
                    usage: wgpu::TextureUsages::TEXTURE_BINDING,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor { dimension: Some(view_dimension), ..Default::default() })
        };
        Ok(Self {
            samplers: Samplers::new(gpu),
            keyboard: picture("keyboard", 256, 3, wgpu::TextureFormat::R8Unorm)?,
            nothing_2d: picture("nothing", 1, 1, wgpu::TextureFormat::Rgba8Unorm)?,
            nothing_3d: view(wgpu::TextureDimension::D3, 1, wgpu::TextureViewDimension::D3),
            nothing_cube: view(wgpu::TextureDimension::D2, 6, wgpu::TextureViewDimension::Cube),
        })
    }
}

/// The bind groups of one draw.
pub(super) struct DrawBindings {
    /// Of each program.
    uniforms: Vec<wgpu::BindGroup>,
    /// By which of its two textures each channel's target shows, a bit for each; made when first needed.
    channels: [Option<wgpu::BindGroup>; 16],
}

impl DrawBindings {
    pub fn of(uniforms: Vec<wgpu::BindGroup>) -> Self {
        Self { uniforms, channels: Default::default() }
    }

    /// Uniforms, and the channels as the targets stand now.
    pub fn groups(
        &mut self,
        gpu: &Gpu,
        stock: &Stock,
        compiled: &CompiledDraw,
        draw: &Draw,
        targets: &[Target],
    ) -> (&[wgpu::BindGroup], &wgpu::BindGroup) {
        let front = |read: &Option<Read>| match read.as_ref().map(|r| &r.source) {
            Some(Source::Target { index, .. }) => targets[*index].front,
            _ => 0,
        };
        let key = draw.reads.iter().enumerate().fold(0, |key, (i, read)| key | front(read) << i);
        let make = || channel_group(gpu, stock, compiled, draw, targets);
        (&self.uniforms, self.channels[key].get_or_insert_with(make))
    }
}

pub(super) fn make(gpu: &Gpu, program: &Program, uniforms: &Uniforms) -> Vec<DrawBindings> {
    program
        .draws
        .iter()
        .enumerate()
        .map(|(index, compiled)| {
            let programs = 0..compiled.programs.len();
            DrawBindings::of(programs.map(|n| uniform_group(gpu, compiled, n, index, uniforms)).collect())
        })
        .collect()
}

/// Uniforms of program `n` of draw `index`.
pub(super) fn uniform_group(
    gpu: &Gpu,
    compiled: &CompiledDraw,
    n: usize,
    index: usize,
    uniforms: &Uniforms,
) -> wgpu::BindGroup {
    let program = &compiled.programs[n];
    let offset = index as u64 * UNIFORM_STRIDE;
    let size = std::num::NonZero::new(size_of::<UniformBlock>() as u64);
    let block = wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer: &uniforms.buffer, offset, size });
    let mut entries = vec![wgpu::BindGroupEntry { binding: 0, resource: block }];
    for (binding, table) in &program.tables {
        entries.push(wgpu::BindGroupEntry { binding: *binding, resource: table.as_entire_binding() });
    }
    if !compiled.knobs.is_empty() {
        entries.push(wgpu::BindGroupEntry {
            binding: interface::KNOB_BINDING,
            resource: uniforms.knobs.as_entire_binding(),
        });
    }
    if compiled.reads_geometry {
        let size = std::num::NonZero::new(size_of::<GeometryBlock>() as u64);
        let offset = (compiled.first_mesh + n) as u64 * GEOMETRY_STRIDE;
        let block = wgpu::BufferBinding { buffer: &uniforms.geometry, offset, size };
        let resource = wgpu::BindingResource::Buffer(block);
        entries.push(wgpu::BindGroupEntry { binding: interface::GEOMETRY_BINDING, resource });
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("uniforms"),
        layout: &program.pipeline.layouts[interface::UNIFORM_GROUP as usize],
        entries: &entries,
    })
}

fn channel_group(
    gpu: &Gpu,
    stock: &Stock,
    compiled: &CompiledDraw,
    draw: &Draw,
    targets: &[Target],
) -> wgpu::BindGroup {
    let mut entries = Vec::new();
    for (index, channel) in compiled.channels.iter().enumerate() {
        let read = draw.reads[index].as_ref();
        if channel.texture {
            entries.push(wgpu::BindGroupEntry {
                binding: interface::texture_binding(index),
                resource: wgpu::BindingResource::TextureView(view(stock, channel, read, targets)),
            });
        }
        if channel.sampler {
            entries.push(wgpu::BindGroupEntry {
                binding: interface::sampler_binding(index),
                resource: wgpu::BindingResource::Sampler(sampler(stock, channel, read)),
            });
        }
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("channels"),
        // The same for every program of the pass.
        layout: &compiled.programs[0].pipeline.layouts[interface::CHANNEL_GROUP as usize],
        entries: &entries,
    })
}

fn view<'a>(
    stock: &'a Stock,
    channel: &'a BoundChannel,
    read: Option<&Read>,
    targets: &'a [Target],
) -> &'a wgpu::TextureView {
    match (read.map(|r| &r.source), channel.kind) {
        // Whether that is this frame's or one before it is the plan's order.
        (Some(Source::Target { index, .. }), _) => {
            let texture = targets[*index].newest();
            // Filtering by hand goes by the levels it finds.
            let by_hand = read.is_some_and(|r| r.sampler.filter == Filter::Linear) && !channel.filters;
            if by_hand { &texture.level_0 } else { &texture.all_levels }
        }
        (Some(Source::Keyboard), _) => &stock.keyboard.all_levels,
        (_, ChannelKind::Sampler2D) => channel.media.as_ref().map_or(&stock.nothing_2d.all_levels, |m| &m.all_levels),
        (_, ChannelKind::Sampler3D) => &stock.nothing_3d,
        (_, ChannelKind::SamplerCube) => &stock.nothing_cube,
    }
}

fn sampler<'a>(stock: &'a Stock, channel: &BoundChannel, read: Option<&Read>) -> &'a wgpu::Sampler {
    let (filter, wrap) = read.map_or((Filter::Nearest, Wrap::Clamp), |r| (r.sampler.filter, r.sampler.wrap));
    let filtering = match filter {
        // By hand, in the shader.
        Filter::Mipmap if !channel.filters => Filtering::NearestOfLevel,
        _ if !channel.filters => Filtering::Nearest,
        Filter::Nearest => Filtering::Nearest,
        Filter::Linear => Filtering::Linear,
        Filter::Mipmap => Filtering::Trilinear,
    };
    let address = match wrap {
        Wrap::Clamp => Address::Clamp,
        Wrap::Repeat => Address::Repeat,
    };
    stock.samplers.get(filtering, address)
}
