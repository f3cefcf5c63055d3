//! Pipelines that draw one triangle over the whole target.

use super::{Gpu, GpuError, spirv};

const VERTEX: &str = "
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
";

/// One slot of a bind group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// A uniform buffer of at least so many bytes.
    Uniform { bytes: u64 },
    /// A storage buffer that is only read.
    Storage,
    /// A sampled float texture.
    Texture { dimension: wgpu::TextureViewDimension, filterable: bool },
    /// `filtering`: may filter, and so only read filterable textures.
    Sampler { filtering: bool },
}

impl Binding {
    fn entry(self, binding: u32, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
        let ty = match self {
            Binding::Uniform { bytes } => wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: std::num::NonZero::new(bytes),
            },
            Binding::Storage => wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            Binding::Texture { dimension, filterable } => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable },
                view_dimension: dimension,
                multisampled: false,
            },
            Binding::Sampler { filtering } => wgpu::BindingType::Sampler(if filtering {
                wgpu::SamplerBindingType::Filtering
            } else {
                wgpu::SamplerBindingType::NonFiltering
            }),
        };
        let visibility = match self {
            // Not every device lets a vertex shader read one.
            Binding::Storage => wgpu::ShaderStages::FRAGMENT,
            _ => visibility,
        };
        wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
    }
}

/// A shader of the front end.
#[derive(Clone, Copy)]
pub struct Shader<'a> {
    pub module: &'a naga::Module,
    /// Arrays of at least so many scalars that the module's own variables hold are written before anything reads them,
    /// if their variables have no initialiser.
    pub filled_arrays: Option<u32>,
}

/// A fragment shader over the whole target.
pub struct FragmentPipelineDescriptor<'a> {
    pub label: &'a str,
    pub shader: Shader<'a>,
    pub entry_point: &'a str,
    /// Bind groups from 0 on: binding number and what lies there.
    pub groups: &'a [Vec<(u32, Binding)>],
    pub target: wgpu::TextureFormat,
}

/// A compiled pipeline and the layouts its bind groups are made with.
pub struct Pipeline {
    pub raw: wgpu::RenderPipeline,
    pub layouts: Vec<wgpu::BindGroupLayout>,
}

impl Pipeline {
    /// Compiles. The module must be valid and clamp its indices itself; what the graphics layer refuses all the same is
    /// Eddy's bug and comes back as [`GpuError::Refused`].
    pub fn new(gpu: &Gpu, descriptor: FragmentPipelineDescriptor<'_>) -> Result<Pipeline, GpuError> {
        let FragmentPipelineDescriptor { label, shader, entry_point, groups, target } = descriptor;
        let layouts = layouts(gpu, label, groups, wgpu::ShaderStages::FRAGMENT);
        let raw = gpu.guarded(label, || {
            let layout = pipeline_layout(gpu, label, &layouts);
            let vertex = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("full-screen triangle"),
                source: wgpu::ShaderSource::Wgsl(VERTEX.into()),
            });
            let fragment = shader_module(gpu, label, shader, groups);
            full_screen(gpu, label, &layout, &vertex, &fragment, entry_point, target)
        })?;
        Ok(Pipeline { raw, layouts })
    }
}

pub(super) fn layouts(
    gpu: &Gpu,
    label: &str,
    groups: &[Vec<(u32, Binding)>],
    visibility: wgpu::ShaderStages,
) -> Vec<wgpu::BindGroupLayout> {
    let layout = |bindings: &Vec<(u32, Binding)>| {
        let entries: Vec<_> = bindings.iter().map(|(binding, kind)| kind.entry(*binding, visibility)).collect();
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
    };
    groups.iter().map(layout).collect()
}

pub(super) fn pipeline_layout(gpu: &Gpu, label: &str, layouts: &[wgpu::BindGroupLayout]) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &layouts.iter().map(Some).collect::<Vec<_>>(),
        immediate_size: 0,
    })
}

/// A module of the front end, for a pass or a stage of a mesh, in a pipeline with these bind groups.
pub(super) fn shader_module(
    gpu: &Gpu,
    label: &str,
    shader: Shader<'_>,
    groups: &[Vec<(u32, Binding)>],
) -> wgpu::ShaderModule {
    let Shader { module, filled_arrays } = shader;
    if let Some(filled_arrays) = filled_arrays.filter(|_| gpu.wants_array_loops && !gpu.runtime_checks)
        && let Some(made) = spirv::shader_module(gpu, label, module, filled_arrays, groups)
    {
        return made;
    }
    let mut checks = wgpu::ShaderRuntimeChecks::checked();
    // Counting every loop's turns up to 2^64 costs time in each and keeps no shader from running for hours.
    checks.force_loop_bounding = gpu.runtime_checks;
    // Divisors of integers come guarded from the front end (`glsl/lower/divide.rs`): x86 traps on a division by zero,
    // and Mesa on that of the least int by -1 already when it folds constants.
    checks.int_div_checks = gpu.runtime_checks;
    // Indices come clamped from the front end (`glsl/lower/access.rs`) where they are not known to be in range
    // (`glsl/lower/ranges.rs`). Fetches outside a texture give zeros by the hardware or the driver's image robustness
    // everywhere but on Metal.
    checks.bounds_checks = gpu.runtime_checks || gpu.info.backend == wgpu::Backend::Metal;
    // SAFETY: `module` comes from the front end's lowering and nowhere else, and wgpu validates it; what the checks
    // leave out is done there:
    // - No index reaches past what it goes into. `ranges.rs` says what that rests on: bounds hold where they were
    //   derived, and code that is written out again elsewhere asks anew. `tests/glsl_bounds.rs` has each way in which
    //   that happens, and `tests/random_programs.rs` holds random programs against ones with every index clamped in
    //   their text.
    // - No division of integers traps: `tests/glsl_division.rs`, and the same random programs.
    // - Loops are not bounded. One that never ends keeps the device busy until the driver's watchdog ends it, with
    //   wgpu's counter up to 2^64 as without.
    unsafe {
        gpu.device.create_shader_module_trusted(
            wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module.clone())),
            },
            checks,
        )
    }
}

/// A pipeline of one triangle over the whole target, no blending, no depth.
pub(super) fn full_screen(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::PipelineLayout,
    vertex: &wgpu::ShaderModule,
    fragment: &wgpu::ShaderModule,
    entry_point: &str,
    target: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: vertex,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: fragment,
            entry_point: Some(entry_point),
            // Textures and private variables start as zeros without this; workgroup memory there is none.
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: target,
                blend: None,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
