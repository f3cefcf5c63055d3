//! Pipelines that draw one triangle over the whole target.

use super::{
    Binding, Gpu, GpuError,
    bindings::{layouts, pipeline_layout},
    full_screen, spirv,
};

/// A shader of the front end.
#[derive(Clone, Copy)]
pub struct Shader<'a> {
    pub module: &'a naga::Module,
    /// Arrays of at least so many scalars that the module's own variables hold are written before anything reads them,
    /// if their variables have no initialiser.
    pub initialized_arrays: Option<u32>,
}

/// A fragment shader over the whole target.
pub struct FragmentPipelineDescriptor<'a> {
    pub label: &'a str,
    pub shader: Shader<'a>,
    pub entry_point: &'a str,
    /// Bind groups from 0 on: binding number and what lies there.
    pub groups: &'a [Vec<(u32, Binding)>],
    /// The format of each target, and whether the shader has an output for it.
    pub targets: &'a [(wgpu::TextureFormat, bool)],
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
        let FragmentPipelineDescriptor { label, shader, entry_point, groups, targets } = descriptor;
        let layouts = layouts(gpu, label, groups, wgpu::ShaderStages::FRAGMENT);
        let raw = gpu.guarded(label, || {
            let layout = pipeline_layout(gpu, label, &layouts);
            let fragment = shader_module(gpu, label, shader, groups);
            full_screen::pipeline(gpu, label, &layout, (&fragment, entry_point), targets)
        })?;
        Ok(Pipeline { raw, layouts })
    }
}

/// A module of the front end, for a pass or a stage of a mesh, in a pipeline with these bind groups.
pub(super) fn shader_module(
    gpu: &Gpu,
    label: &str,
    shader: Shader<'_>,
    groups: &[Vec<(u32, Binding)>],
) -> wgpu::ShaderModule {
    let Shader { module, initialized_arrays } = shader;
    if let Some(initialized_arrays) = initialized_arrays.filter(|_| gpu.wants_array_loops && !gpu.runtime_checks)
        && let Some(made) = spirv::shader_module(gpu, label, module, initialized_arrays, groups)
    {
        return made;
    }
    let mut checks = wgpu::ShaderRuntimeChecks::checked();
    // Counting every loop's turns up to 2^64 costs time in each and keeps no shader from running for hours.
    checks.force_loop_bounding = gpu.runtime_checks;
    // Divisors of integers come guarded from the front end (`glsl/lower/divide.rs`): x86 traps on a division by zero,
    // and Mesa on that of the least int by -1 already when it folds constants.
    checks.int_div_checks = gpu.runtime_checks;
    // Indices come clamped from the front end (`glsl/lower/access.rs`) but where they are known to be in range
    // (`glsl/opt/ranges`). Fetches outside a texture give zeros by the hardware or the driver's image robustness
    // everywhere but on Metal.
    checks.bounds_checks = gpu.runtime_checks || gpu.info.backend == wgpu::Backend::Metal;
    // SAFETY: `module` comes from the front end's lowering and nowhere else, and wgpu validates it; what the checks
    // leave out is done there:
    // - No index reaches past what it goes into. `opt/ranges` says what that rests on: a bound holds where it is
    //   used. `tests/it/glsl_bounds.rs` has each way in which
    //   that happens, and `tests/it/random_programs` holds random programs against ones with every index clamped in
    //   their text.
    // - No division of integers traps: `tests/it/glsl_division.rs`, and the same random programs.
    // - Loops that may never end are left after some million rounds where the device may hang
    //   (`glsl/emit/work_arounds/endless_loops.rs`).
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
