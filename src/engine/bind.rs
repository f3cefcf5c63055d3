//! Bind groups: the textures that the channels of each draw read. Created when first needed and kept for a program and
//! a size, so that a frame only sets them.

use super::{
    pipelines::StagePipeline,
    program::{BoundChannel, CompiledDraw, FillProgram, FilterMode, Program},
    shared::Shared,
    targets::Target,
    uniforms::Uniforms,
};
use eddy_glsl::interface;
use eddy_gpu::{Address, Filtering, Gpu, Texture};
use eddy_graph::{Draw, Read, TexelSource};
use eddy_project::{Filter, Wrap};
use std::collections::BTreeMap;

/// The bind groups of one draw.
pub(super) struct DrawBindings {
    /// One per program; for a cubemap pass, which has one program, one per face.
    uniforms: Vec<wgpu::BindGroup>,
    /// One per selection of textures: bit i selects which of its two textures the target of channel i reads. Created
    /// when first needed. Few selections occur: targets that alternate do so together.
    channels: BTreeMap<u16, wgpu::BindGroup>,
}

impl DrawBindings {
    /// Binds the uniforms of draw `index`.
    fn new(gpu: &Gpu, compiled: &CompiledDraw, index: usize, layers: u32, uniforms: &Uniforms) -> Self {
        let of_layer = |layer| {
            let programs = compiled.body.pipelines().enumerate();
            programs.map(move |program| uniform_group(gpu, compiled, program, (index, layer), uniforms))
        };
        Self { uniforms: (0..layers).flat_map(of_layer).collect(), channels: Default::default() }
    }

    /// The bind groups of the uniforms, and of the channels for the current state of the targets.
    pub(crate) fn groups(
        &mut self,
        shared: &Shared,
        compiled: &CompiledDraw,
        draw: &Draw,
        targets: &[Target],
    ) -> (&[wgpu::BindGroup], &wgpu::BindGroup) {
        let front = |read: &Option<Read>| match read.as_ref().map(|r| &r.source) {
            Some(TexelSource::Target { index, .. }) => targets[*index].front,
            _ => 0,
        };
        let key = draw.reads.iter().enumerate().fold(0, |key, (i, read)| key | (front(read) as u16) << i);
        let make = || channel_group(shared, compiled, draw, targets);
        (&self.uniforms, self.channels.entry(key).or_insert_with(make))
    }
}

/// The bind groups of one draw's fills.
#[derive(Default)]
pub(super) struct FillBindings {
    pub initial: Option<DrawBindings>,
    pub boundary: Option<DrawBindings>,
}

/// The bind groups of a program.
#[derive(Default)]
pub(super) struct Bindings {
    pub draws: Vec<DrawBindings>,
    /// One per draw.
    pub fills: Vec<FillBindings>,
}

impl Bindings {
    pub(crate) fn new(gpu: &Gpu, program: &Program, uniforms: &Uniforms) -> Self {
        let bind = |index, compiled: &CompiledDraw| {
            DrawBindings::new(gpu, compiled, index, program.plan.layers(index), uniforms)
        };
        let fill = |index, fill: &Option<Box<FillProgram>>| fill.as_ref().map(|f| bind(index, &f.compiled));
        let draws = || program.draws.iter().enumerate();
        Self {
            draws: draws().map(|(index, compiled)| bind(index, compiled)).collect(),
            fills: draws()
                .map(|(index, c)| FillBindings { initial: fill(index, &c.initial), boundary: fill(index, &c.boundary) })
                .collect(),
        }
    }
}

/// Draws a fill within the current scissor rectangle. A fill reads no target.
pub(super) fn draw_fill(
    bindings: &mut DrawBindings,
    shared: &Shared,
    fill: &FillProgram,
    pass: &mut wgpu::RenderPass<'_>,
) {
    let (uniforms, channels) = bindings.groups(shared, &fill.compiled, &fill.draw, &[]);
    pass.set_bind_group(interface::CHANNEL_GROUP, channels, &[]);
    for (program, uniforms) in fill.compiled.body.pipelines().zip(uniforms) {
        pass.set_pipeline(&program.pipeline.raw);
        pass.set_bind_group(interface::UNIFORM_GROUP, uniforms, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Binds the uniforms of program `n` of a layer of draw `index`.
pub(super) fn uniform_group(
    gpu: &Gpu,
    compiled: &CompiledDraw,
    (n, program): (usize, &StagePipeline),
    (index, layer): (usize, u32),
    uniforms: &Uniforms,
) -> wgpu::BindGroup {
    let mut entries = vec![wgpu::BindGroupEntry { binding: 0, resource: uniforms.block_binding(index, layer) }];
    for (binding, table) in &program.tables {
        entries.push(wgpu::BindGroupEntry { binding: *binding, resource: table.as_entire_binding() });
    }
    if !compiled.custom_uniforms.is_empty() {
        entries.push(wgpu::BindGroupEntry {
            binding: interface::CUSTOM_UNIFORM_BINDING,
            resource: uniforms.custom_uniform_binding(),
        });
    }
    if compiled.reads_geometry {
        let resource = uniforms.mesh_binding(compiled.body.geometry_blocks().start + n);
        entries.push(wgpu::BindGroupEntry { binding: interface::GEOMETRY_BINDING, resource });
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("uniforms"),
        layout: &program.pipeline.layouts[interface::UNIFORM_GROUP as usize],
        entries: &entries,
    })
}

fn channel_group(shared: &Shared, compiled: &CompiledDraw, draw: &Draw, targets: &[Target]) -> wgpu::BindGroup {
    let texture = |index: usize| match draw.reads[index].as_ref().map(|r| &r.source) {
        // The order of the plan determines whether that is the current frame's or the previous one's.
        Some(TexelSource::Target { index, .. }) => Some(targets[*index].newest()),
        _ => compiled.channels[index].external.as_ref().map(|external| &external.texture),
    };
    // The layout is equal for every program of the pass, and there is at least one.
    let first = compiled.body.pipelines().next().expect("a pass has a program");
    let layout = &first.pipeline.layouts[interface::CHANNEL_GROUP as usize];
    channel_group_of(shared, compiled, draw, layout, texture)
}

/// Binds these textures to the channels of a draw.
pub(super) fn channel_group_of<'t>(
    shared: &Shared,
    compiled: &CompiledDraw,
    draw: &Draw,
    layout: &wgpu::BindGroupLayout,
    texture: impl Fn(usize) -> Option<&'t Texture>,
) -> wgpu::BindGroup {
    let mut entries = Vec::new();
    for (index, channel) in compiled.channels.iter().enumerate() {
        let read = draw.reads[index].as_ref();
        if channel.texture {
            entries.push(wgpu::BindGroupEntry {
                binding: interface::texture_binding(index),
                resource: wgpu::BindingResource::TextureView(match texture(index) {
                    Some(texture) => view(texture, channel, read),
                    None => shared.fallbacks.of(channel.dimension),
                }),
            });
        }
        if channel.sampler {
            entries.push(wgpu::BindGroupEntry {
                binding: interface::sampler_binding(index),
                resource: wgpu::BindingResource::Sampler(sampler(shared, channel, read)),
            });
        }
    }
    shared.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("channels"),
        layout,
        entries: &entries,
    })
}

/// Returns the levels of a texture that a channel reads.
fn view<'t>(texture: &'t Texture, channel: &BoundChannel, read: Option<&Read>) -> &'t wgpu::TextureView {
    // Filtering in the shader uses the mip levels that exist.
    let is_target = read.is_some_and(|read| matches!(read.source, TexelSource::Target { .. }));
    let is_linear = read.is_some_and(|r| r.sampler.filter == Filter::Linear);
    let one_level = is_target && is_linear && channel.filter_mode == FilterMode::Shader;
    if one_level { &texture.level_0 } else { &texture.all_levels }
}

fn sampler<'a>(shared: &'a Shared, channel: &BoundChannel, read: Option<&Read>) -> &'a wgpu::Sampler {
    let (filter, wrap) = read.map_or((Filter::Nearest, Wrap::Clamp), |r| (r.sampler.filter, r.sampler.wrap));
    let filtering = match (channel.filter_mode, filter) {
        // The shader selects the level.
        (FilterMode::Shader | FilterMode::Nearest, Filter::Mipmap) => Filtering::NearestOfLevel,
        (FilterMode::Shader | FilterMode::Nearest, _) | (_, Filter::Nearest) => Filtering::Nearest,
        (FilterMode::Sampler, Filter::Linear) => Filtering::Linear,
        (FilterMode::Sampler, Filter::Mipmap) => Filtering::Trilinear,
    };
    let address = match wrap {
        Wrap::Clamp => Address::Clamp,
        Wrap::Repeat => Address::Repeat,
    };
    shared.samplers.get(filtering, address)
}
