//! SPIR-V that differs from what wgpu's Vulkan backend writes: long arrays have no zero initialisers ([`zeros`]),
//! variables outside of buffers have no memory layout ([`layouts`]), and extremes ignore NaN ([`extremes`]).

use std::borrow::Cow;

use naga::{
    AddressSpace, Expression, Function, MathFunction, TypeInner,
    back::spv,
    proc::{BoundsCheckPolicies, BoundsCheckPolicy},
    valid::{Capabilities, ValidationFlags, Validator},
};

use super::{Binding, Gpu, Shader};

mod extremes;
mod layouts;
#[cfg(test)]
mod tests;
mod words;
mod zeros;

/// Returns whether wgpu's SPIR-V for a module has anything to change.
///
/// Other modules are left to wgpu, which compares their resources with the layouts of the pipeline: most modules of the
/// tests are checked in this way.
pub(super) fn differs(gpu: &Gpu, shader: Shader<'_>) -> bool {
    let module = shader.module;
    let has_parts = |ty| matches!(module.types[ty].inner, TypeInner::Array { .. } | TypeInner::Struct { .. });
    let is_own = |space| matches!(space, AddressSpace::Private | AddressSpace::WorkGroup);
    let has_own_parts = |f: &Function| f.local_variables.iter().any(|(_, variable)| has_parts(variable.ty));
    let is_extreme = |expression: &Expression| {
        use MathFunction::{Clamp, Max, Min, Saturate};
        matches!(expression, Expression::Math { fun: Min | Max | Clamp | Saturate, .. })
    };
    let has_extreme = |f: &Function| f.expressions.iter().any(|(_, expression)| is_extreme(expression));
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    let mut functions = module.functions.iter().map(|(_, f)| f).chain(entries);
    shader.initialized_arrays.is_some()
        || module.global_variables.iter().any(|(_, variable)| is_own(variable.space) && has_parts(variable.ty))
        || functions.any(|f| has_own_parts(f) || gpu.nan_extremes && has_extreme(f))
}

/// Creates a Vulkan shader module from a module of the front end whose arrays of at least `initialized_arrays` scalars
/// are filled before they are read. The bind groups are those of the pipeline. `None` if naga rejects the module or has
/// no SPIR-V for it.
pub(super) fn shader_module(
    gpu: &Gpu,
    label: &str,
    shader: Shader<'_>,
    groups: &[Vec<(u32, Binding)>],
) -> Option<wgpu::ShaderModule> {
    let entry = shader.module.entry_points.first()?;
    let mut words = words(shader.module, groups, gpu.info.vendor)?;
    if let Some(least) = shader.initialized_arrays {
        words = zeros::without_zeros(&words, least);
    }
    let mut words = layouts::without_layouts(&words).unwrap_or(words);
    if gpu.nan_extremes {
        words = extremes::ignoring_nan(&words);
    }
    let entry_point = wgpu::PassthroughShaderEntryPoint { name: Cow::Borrowed(&entry.name), workgroup_size: (0, 0, 0) };
    // SAFETY: the driver gets the same SPIR-V as from wgpu, without some initialisers and decorations, and with
    // defined extremes:
    // - `words` validates the module like wgpu and writes it with the writer and the options of wgpu's Vulkan backend
    //   that `pipeline::checked_module` uses; the omitted checks are documented there.
    // - The resources are those of the pipeline's layout: `binding_map` numbers them like wgpu.
    // - A variable without an initialiser is undefined until it is written. `without_zeros` removes only those of
    //   arrays of `initialized_arrays` scalars, which the front end fills before they are read, at the start of
    //   the variable's function or of the program (`glsl/emit/long_arrays`), or by the program itself
    //   (`glsl::ir::Var::init` and `GlobalKind::Private`).
    //   `tests/it/long_arrays.rs` reads such arrays without writing to them.
    // - `without_layouts` leaves the types of buffers as they are, and offsets have no meaning for other variables.
    //   `tests/it/validation.rs` has such modules checked by the validation layer.
    // - `ignoring_nan` replaces instructions by others that define more.
    let module = unsafe {
        gpu.device.create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
            label: Some(label),
            entry_points: Cow::Borrowed(&[entry_point]),
            spirv: Some(Cow::Borrowed(&words)),
            ..Default::default()
        })
    };
    Some(module)
}

/// Qualcomm's number as a vendor of PCI devices.
const QUALCOMM: u32 = 0x5143;

/// Returns the module as wgpu's Vulkan backend writes it without runtime checks for a driver of this vendor
/// (`compile_stage` and `device_from_raw` in wgpu-hal's `vulkan`), but in the version that every driver reads.
fn words(module: &naga::Module, groups: &[Vec<(u32, Binding)>], vendor: u32) -> Option<Vec<u32>> {
    use spv::Capability as C;
    let capabilities = Capabilities::default() | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    let info = Validator::new(ValidationFlags::all(), capabilities).validate(module).ok()?;
    let entry = module.entry_points.first()?;
    let unchecked = BoundsCheckPolicy::Unchecked;
    let mut flags = spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::FORCE_POINT_SIZE;
    // wgpu-hal gives Qualcomm's drivers no names of varyings.
    flags.set(spv::WriterFlags::LABEL_VARYINGS, vendor != QUALCOMM);
    let options = spv::Options {
        // naga's writer does not use later versions for Eddy's features.
        lang_version: (1, 0),
        flags,
        // The capabilities that every Vulkan device has.
        capabilities: Some(
            [C::Shader, C::Matrix, C::Sampled1D, C::Image1D, C::ImageQuery, C::DerivativeControl].into_iter().collect(),
        ),
        bounds_check_policies: BoundsCheckPolicies {
            index: unchecked,
            buffer: unchecked,
            image_load: unchecked,
            binding_array: unchecked,
        },
        force_loop_bounding: false,
        emit_int_div_checks: false,
        binding_map: binding_map(groups),
        ..Default::default()
    };
    let pipeline = spv::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone() };
    spv::write_vec(module, &info, &options, Some(&pipeline)).ok()
}

/// wgpu numbers the bindings of each Vulkan set from 0, in order.
fn binding_map(groups: &[Vec<(u32, Binding)>]) -> spv::BindingMap {
    let mut map = spv::BindingMap::new();
    for (group, bindings) in (0..).zip(groups) {
        let mut numbers: Vec<u32> = bindings.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        for (binding, number) in (0..).zip(numbers) {
            let place = naga::ResourceBinding { group, binding: number };
            map.insert(place, spv::BindingInfo { descriptor_set: group, binding, binding_array_size: None });
        }
    }
    map
}
