//! Pipelines that draw one triangle over the whole target.

use super::{
    Binding, Gpu, GpuError,
    bindings::{layouts, pipeline_layout},
    full_screen,
    limits::check_bindings,
    spirv,
};

/// A shader from the front end.
#[derive(Clone, Copy)]
pub struct Shader<'a> {
    pub module: &'a naga::Module,
    /// Arrays of at least this many scalars in the module's own variables are written before they are read, if their
    /// variables have no initialiser.
    pub initialized_arrays: Option<u32>,
}

/// A fragment shader for the whole target.
pub struct FragmentPipelineDescriptor<'a> {
    pub label: &'a str,
    pub shader: Shader<'a>,
    pub entry_point: &'a str,
    /// Bind groups from 0: binding numbers and their resources.
    pub groups: &'a [Vec<(u32, Binding)>],
    /// The format of each target, and whether the shader has an output for it.
    pub targets: &'a [(wgpu::TextureFormat, bool)],
}

/// A compiled pipeline and the layouts of its bind groups.
pub struct Pipeline {
    pub raw: wgpu::RenderPipeline,
    pub layouts: Vec<wgpu::BindGroupLayout>,
}

impl Pipeline {
    /// Compiles a pipeline. The module must be valid and clamp its indices itself; if the graphics layer rejects it
    /// nevertheless, that is a bug in Eddy, which is returned as [`GpuError::Refused`].
    pub fn new(gpu: &Gpu, descriptor: FragmentPipelineDescriptor<'_>) -> Result<Pipeline, GpuError> {
        let FragmentPipelineDescriptor { label, shader, entry_point, groups, targets } = descriptor;
        check_bindings(gpu, label, groups)?;
        let layouts = layouts(gpu, label, groups, wgpu::ShaderStages::FRAGMENT);
        let raw = gpu.guarded(label, || {
            let layout = pipeline_layout(gpu, label, &layouts);
            let [fragment] = shader_modules(gpu, label, [shader], groups);
            full_screen::pipeline(gpu, label, &layout, (&fragment, entry_point), targets)
        })?;
        Ok(Pipeline { raw, layouts })
    }
}

/// Creates modules of the front end, for a pass or the stages of a mesh, in a pipeline with these bind groups.
pub(super) fn shader_modules<const N: usize>(
    gpu: &Gpu,
    label: &str,
    shaders: [Shader<'_>; N],
    groups: &[Vec<(u32, Binding)>],
) -> [wgpu::ShaderModule; N] {
    // wgpu knows no outputs of a vertex stage that it has not read, and misses them if it has read the fragment stage:
    // all stages of a pipeline are passed, or none.
    if gpu.passes_spirv && !gpu.runtime_checks && shaders.iter().any(|&shader| spirv::differs(gpu, shader)) {
        let made = shaders.map(|shader| spirv::shader_module(gpu, label, shader, groups));
        if made.iter().all(Option::is_some) {
            return made.map(|module| module.expect("checked above"));
        }
    }
    shaders.map(|shader| checked_module(gpu, label, shader))
}

/// Creates a module that wgpu validates.
fn checked_module(gpu: &Gpu, label: &str, shader: Shader<'_>) -> wgpu::ShaderModule {
    let mut checks = wgpu::ShaderRuntimeChecks::checked();
    // Counting every loop's iterations up to 2^64 costs time in each and does not keep a shader from running for hours.
    checks.force_loop_bounding = gpu.runtime_checks;
    // The front end guards divisors of integers (`glsl/lower/divide.rs`): x86 traps on a division by zero, and Mesa
    // traps on the division of the smallest int by -1 even when it folds constants.
    checks.int_div_checks = gpu.runtime_checks;
    // The front end clamps indices (`glsl/lower/access.rs`) unless they are known to be in range (`glsl/opt/ranges`).
    // Fetches outside a texture return zeros by the hardware or the driver's image robustness everywhere except on
    // Metal.
    checks.bounds_checks = gpu.runtime_checks || gpu.info.backend == wgpu::Backend::Metal;
    // SAFETY: the module always comes from the front end's lowering, and wgpu validates it; the omitted checks are done
    // there:
    // - Every index is in bounds. `opt/ranges` documents the reasoning: a bound is valid where it is used.
    //   `tests/it/glsl_bounds.rs` covers each of its cases, and `tests/it/random_programs` compares random programs
    //   with versions of them in which every index is clamped in the text.
    // - No division of integers traps: `tests/it/glsl_division.rs`, and the same random programs.
    // - Endless loops are left after some million iterations if the device may hang
    //   (`glsl/emit/work_arounds/endless_loops.rs`).
    unsafe {
        gpu.device.create_shader_module_trusted(
            wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(shader.module.clone())),
            },
            checks,
        )
    }
}
