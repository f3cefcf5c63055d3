//! Writes one stage in a language.

use std::collections::HashMap;

use eddy_glsl::naga;
use naga::{
    Binding, Module, ResourceBinding, Sampling, ShaderStage, TypeInner,
    back::{glsl, hlsl, msl, spv, wgsl},
    proc::{BoundsCheckPolicies, BoundsCheckPolicy},
    valid::{Capabilities, ModuleInfo, ValidationFlags, Validator},
};

use crate::{
    Language, bindings,
    glsl::{selects_integers, with_integer_mix},
    hlsl::with_sampler_registers,
    names,
    wgsl::for_browsers,
};

/// A stage in another language.
pub(crate) struct Written {
    pub bytes: Vec<u8>,
    pub entry_point: String,
    /// The module that was written, with named resources.
    pub module: Module,
    /// The names of blocks and samplers in GLSL.
    pub glsl_names: HashMap<ResourceBinding, String>,
}

/// Indices are already clamped by the compiler, and fetches outside of a texture return zeros everywhere except on
/// Metal, and in OpenGL and Vulkan with robust access.
fn policies(language: Language) -> BoundsCheckPolicies {
    let unchecked = BoundsCheckPolicy::Unchecked;
    let image_load = if language == Language::Msl { BoundsCheckPolicy::ReadZeroSkipWrite } else { unchecked };
    BoundsCheckPolicies { index: unchecked, buffer: unchecked, image_load, binding_array: unchecked }
}

/// Stack for writers, whose recursion is as deep as the nesting of the program.
const STACK: usize = 64 << 20;

/// Writes the single entry point of a module. `next` is the fragment stage that follows a vertex stage. Returns naga's
/// message as the error.
pub(crate) fn write(module: &Module, next: Option<&Module>, language: Language) -> Result<Written, String> {
    stacker::maybe_grow(STACK / 4, STACK, || write_here(module, next, language))
}

fn write_here(module: &Module, next: Option<&Module>, language: Language) -> Result<Written, String> {
    let mut module = module.clone();
    names::add(&mut module);
    if matches!(language, Language::Glsl(_)) {
        allow_any_provoking_vertex(&mut module);
    }
    let info = validated(&module)?;
    let entry = module.entry_points.first().ok_or("there is no entry point")?;
    let (stage, name) = (entry.stage, entry.name.clone());
    let mut glsl_names = HashMap::new();
    let mut entry_point = name.clone();
    let bytes = match language {
        Language::Wgsl => {
            let text = wgsl::write_string(&module, &info, wgsl::WriterFlags::empty()).map_err(|e| e.to_string())?;
            for_browsers(&text).into_bytes()
        }
        Language::Hlsl => {
            let (text, renamed) = hlsl_text(&module, &info, next)?;
            entry_point = renamed;
            text.into_bytes()
        }
        Language::Msl => {
            let (text, renamed) = msl_text(&module, &info, &name)?;
            entry_point = renamed;
            text.into_bytes()
        }
        Language::Glsl(version) => {
            let options = glsl::Options {
                version: version.of_naga(),
                // Restores OpenGL's y and depth.
                writer_flags: glsl::WriterFlags::ADJUST_COORDINATE_SPACE,
                binding_map: bound_resources(&module).map(|b| (b, bindings::slot(b) as u8)).collect(),
                ..Default::default()
            };
            let pipeline = glsl::PipelineOptions { shader_stage: stage, entry_point: name, multiview: None };
            let mut text = String::new();
            let mut writer = glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies(language))
                .map_err(|e| e.to_string())?;
            let reflection = writer.write().map_err(|e| e.to_string())?;
            let textures = reflection.texture_mapping.into_iter().map(|(name, mapping)| (mapping.texture, name));
            for (handle, name) in reflection.uniforms.into_iter().chain(textures) {
                glsl_names.extend(module.global_variables[handle].binding.map(|binding| (binding, name)));
            }
            if !version.has_integer_mix() && selects_integers(&module, &info) {
                text = with_integer_mix(&text);
            }
            text.into_bytes()
        }
        Language::Spirv => {
            let words = spirv_words(&module, &info, stage, name)?;
            words.into_iter().flat_map(u32::to_le_bytes).collect()
        }
    };
    Ok(Written { bytes, entry_point, module, glsl_names })
}

fn bound_resources(module: &Module) -> impl Iterator<Item = ResourceBinding> {
    module.global_variables.iter().filter_map(|(_, variable)| variable.binding)
}

fn validated(module: &Module) -> Result<ModuleInfo, String> {
    let capabilities = Capabilities::default() | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    let info = Validator::new(ValidationFlags::all(), capabilities).validate(module);
    info.map_err(|error| error.into_inner().to_string())
}

fn hlsl_text(module: &Module, info: &ModuleInfo, next: Option<&Module>) -> Result<(String, String), String> {
    let target = |binding| hlsl::BindTarget { space: 0, register: bindings::slot(binding), ..Default::default() };
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V5_1,
        binding_map: bound_resources(module).map(|binding| (binding, target(binding))).collect(),
        fake_missing_bindings: true,
        restrict_indexing: false,
        force_loop_bounding: false,
        ..Default::default()
    };
    let pipeline = hlsl::PipelineOptions::default();
    let mut text = String::new();
    let fragment = next.and_then(|next| hlsl::FragmentEntryPoint::new(next, &next.entry_points.first()?.name));
    let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
    let written = writer.write(module, info, fragment.as_ref()).map_err(|e| e.to_string())?;
    let name = written.entry_point_names.into_iter().next().ok_or("there is no entry point")?;
    Ok((with_sampler_registers(&text)?, name.map_err(|e| e.to_string())?))
}

fn msl_text(module: &Module, info: &ModuleInfo, entry: &str) -> Result<(String, String), String> {
    let mut resources = msl::BindingMap::new();
    for (variable, binding) in bindings::resources(module) {
        let number = bindings::slot(binding) as u8;
        let target = match module.types[variable.ty].inner {
            TypeInner::Image { .. } => msl::BindTarget { texture: Some(number), ..Default::default() },
            TypeInner::Sampler { .. } => {
                let sampler = Some(msl::BindSamplerTarget::Resource(number));
                msl::BindTarget { sampler, ..Default::default() }
            }
            _ => msl::BindTarget { buffer: Some(number), ..Default::default() },
        };
        resources.insert(binding, target);
    }
    let resources = msl::EntryPointResources { resources, ..Default::default() };
    let options = msl::Options {
        lang_version: (2, 1),
        per_entry_point_map: [(entry.to_owned(), resources)].into_iter().collect(),
        fake_missing_bindings: false,
        bounds_check_policies: policies(Language::Msl),
        force_loop_bounding: false,
        emit_int_div_checks: false,
        ..Default::default()
    };
    let pipeline = msl::PipelineOptions { vertex_pulling_transform: false, ..Default::default() };
    let (text, written) = msl::write_string(module, info, &options, &pipeline).map_err(|e| e.to_string())?;
    let name = written.entry_point_names.into_iter().next().ok_or("there is no entry point")?;
    Ok((text, name.map_err(|e| e.to_string())?))
}

fn spirv_words(module: &Module, info: &ModuleInfo, stage: ShaderStage, entry: String) -> Result<Vec<u32>, String> {
    let place =
        |b: ResourceBinding| spv::BindingInfo { descriptor_set: b.group, binding: b.binding, binding_array_size: None };
    let options = spv::Options {
        lang_version: (1, 3),
        // Negates y, because Vulkan's clip space has it downwards.
        flags: spv::WriterFlags::ADJUST_COORDINATE_SPACE | spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::DEBUG,
        binding_map: bound_resources(module).map(|b| (b, place(b))).collect(),
        bounds_check_policies: policies(Language::Spirv),
        force_loop_bounding: false,
        emit_int_div_checks: false,
        ..Default::default()
    };
    let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: entry };
    spv::write_vec(module, info, &options, Some(&pipeline)).map_err(|e| e.to_string())
}

/// GLSL cannot specify the provoking vertex of a flat value: its writer requires that it is left open.
fn allow_any_provoking_vertex(module: &mut Module) {
    let open = |binding: &mut Option<Binding>| {
        if let Some(Binding::Location { sampling: sampling @ Some(Sampling::First), .. }) = binding {
            *sampling = Some(Sampling::Either);
        }
    };
    let mut changed = Vec::new();
    for (handle, ty) in module.types.iter() {
        let mut ty = ty.clone();
        let TypeInner::Struct { members, .. } = &mut ty.inner else { continue };
        members.iter_mut().for_each(|member| open(&mut member.binding));
        changed.push((handle, ty));
    }
    for (handle, ty) in changed {
        if module.types[handle] != ty {
            module.types.replace(handle, ty);
        }
    }
    for entry in &mut module.entry_points {
        entry.function.arguments.iter_mut().for_each(|argument| open(&mut argument.binding));
        if let Some(result) = &mut entry.function.result {
            open(&mut result.binding);
        }
    }
}
