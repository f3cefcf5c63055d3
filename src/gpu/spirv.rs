//! SPIR-V without the zero initialisers of long arrays.
//!
//! naga's writer gives every variable an initialiser of zeros. lavapipe turns it into one store per scalar in one
//! block, for which LLVM takes time that grows with about the cube of their number. The front end fills such arrays by
//! loops, and here their initialisers are removed.

use std::{borrow::Cow, collections::HashMap};

use naga::{
    back::spv,
    proc::{BoundsCheckPolicies, BoundsCheckPolicy},
    valid::{Capabilities, ValidationFlags, Validator},
};

use super::{Binding, Gpu};

/// Creates a Vulkan shader module from a module of the front end whose arrays of at least this many scalars are filled
/// before they are read. The bind groups are those of the pipeline. `None` if naga rejects the module or has no SPIR-V
/// for it.
pub(super) fn shader_module(
    gpu: &Gpu,
    label: &str,
    module: &naga::Module,
    initialized_arrays: u32,
    groups: &[Vec<(u32, Binding)>],
) -> Option<wgpu::ShaderModule> {
    let entry = module.entry_points.first()?;
    let words = without_zeros(&words(module, groups)?, initialized_arrays);
    let entry_point = wgpu::PassthroughShaderEntryPoint { name: Cow::Borrowed(&entry.name), workgroup_size: (0, 0, 0) };
    // SAFETY: the driver gets the same SPIR-V as from wgpu, without some initialisers:
    // - `words` validates the module like wgpu and writes it with the writer and the options of wgpu's Vulkan backend
    //   that `pipeline::shader_module` uses; the omitted checks are documented there.
    // - The resources are those of the pipeline's layout: `binding_map` numbers them like wgpu.
    // - A variable without an initialiser is undefined until it is written. `without_zeros` removes only those of
    //   arrays of `initialized_arrays` scalars, which the front end fills before they are read, at the start of
    //   the variable's function or of the program (`glsl/emit/long_arrays`), or by the program itself
    //   (`glsl::ir::Var::init` and `GlobalKind::Private`).
    //   `tests/it/long_arrays.rs` reads such arrays without writing to them.
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

/// Returns the module as wgpu's Vulkan backend writes it without runtime checks (`compile_stage` in wgpu-hal's
/// `vulkan/device.rs`).
fn words(module: &naga::Module, groups: &[Vec<(u32, Binding)>]) -> Option<Vec<u32>> {
    use spv::Capability as C;
    let capabilities = Capabilities::default() | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    let info = Validator::new(ValidationFlags::all(), capabilities).validate(module).ok()?;
    let entry = module.entry_points.first()?;
    let unchecked = BoundsCheckPolicy::Unchecked;
    let options = spv::Options {
        // Every lavapipe accepts it, and naga's writer does not use later versions for Eddy's features.
        lang_version: (1, 3),
        flags: spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::FORCE_POINT_SIZE,
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

/// Instructions and storage classes, by the SPIR-V specification, sections 3.52 and 3.7.
mod op {
    pub(super) const TYPE_VECTOR: u32 = 23;
    pub(super) const TYPE_MATRIX: u32 = 24;
    pub(super) const TYPE_ARRAY: u32 = 28;
    pub(super) const TYPE_STRUCT: u32 = 30;
    pub(super) const TYPE_POINTER: u32 = 32;
    pub(super) const CONSTANT: u32 = 43;
    pub(super) const CONSTANT_NULL: u32 = 46;
    pub(super) const VARIABLE: u32 = 59;
    pub(super) const PRIVATE: u32 = 6;
    pub(super) const FUNCTION: u32 = 7;
}

/// The number of words before the first instruction.
const HEADER: usize = 5;

/// Removes zero initialisers of the invocation's own variables that contain an array of at least this many scalars.
fn without_zeros(words: &[u32], least_array: u32) -> Vec<u32> {
    let mut out = words[..HEADER].to_vec();
    // By id: the number of scalars, and that of the longest array inside.
    let mut types: HashMap<u32, (u32, u32)> = HashMap::new();
    let mut pointees: HashMap<u32, u32> = HashMap::new();
    let mut constants: HashMap<u32, u32> = HashMap::new();
    let mut nulls = std::collections::HashSet::new();
    let mut rest = &words[HEADER..];
    while let Some(&first) = rest.first() {
        let (instruction, after) = rest.split_at((first >> 16) as usize);
        rest = after;
        let size = |id: u32| types.get(&id).copied().unwrap_or((1, 0));
        match (first & 0xffff, &instruction[1..]) {
            (op::TYPE_VECTOR | op::TYPE_MATRIX, &[id, part, count]) => {
                let scalars = size(part).0.saturating_mul(count);
                types.insert(id, (scalars, 0));
            }
            (op::TYPE_ARRAY, &[id, element, len]) => {
                let len = constants.get(&len).copied().unwrap_or(0);
                let scalars = size(element).0.saturating_mul(len);
                types.insert(id, (scalars, scalars));
            }
            (op::TYPE_STRUCT, [id, members @ ..]) => {
                let sizes = members.iter().map(|&member| size(member));
                let all = sizes.fold((0u32, 0), |(sum, longest), (scalars, array)| {
                    (sum.saturating_add(scalars), array.max(longest))
                });
                types.insert(*id, all);
            }
            (op::TYPE_POINTER, &[id, _, pointee]) => _ = pointees.insert(id, pointee),
            (op::CONSTANT, &[_, id, value]) => _ = constants.insert(id, value),
            (op::CONSTANT_NULL, &[_, id]) => _ = nulls.insert(id),
            (op::VARIABLE, &[pointer, id, class @ (op::PRIVATE | op::FUNCTION), init])
                if nulls.contains(&init) && pointees.get(&pointer).is_some_and(|&ty| size(ty).1 >= least_array) =>
            {
                out.extend([4 << 16 | op::VARIABLE, pointer, id, class]);
                continue;
            }
            _ => {}
        }
        out.extend_from_slice(instruction);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "
        struct S { a: f32, b: array<vec3<f32>, 8> }
        var<private> long: array<f32, 24>;
        var<private> short: array<f32, 23>;
        var<private> table: array<f32, 24> = array<f32, 24>(
            1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24);
        @group(1) @binding(7) var<uniform> block: array<vec4<f32>, 32>;
        @fragment fn main(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
            var s: S;
            var nested: array<array<f32, 6>, 4>;
            let i = u32(p.x);
            return vec4(long[i] + short[i] + table[i], s.b[i & 7u].x, nested[i & 3u][i & 1u], block[i & 31u].x);
        }";

    fn instructions(words: &[u32], op: u32) -> Vec<Vec<u32>> {
        let mut found = Vec::new();
        let mut rest = &words[HEADER..];
        while let Some(first) = rest.first() {
            let (instruction, after) = rest.split_at((first >> 16) as usize);
            if first & 0xffff == op {
                found.push(instruction.to_vec());
            }
            rest = after;
        }
        found
    }

    fn written() -> Vec<u32> {
        let module = naga::front::wgsl::parse_str(TEXT).expect("valid");
        let uniform = Binding::Uniform { bytes: 512 };
        words(&module, &[vec![], vec![(9, uniform), (7, uniform), (2, uniform)]]).expect("valid")
    }

    #[test]
    fn only_zero_initialisers_of_long_arrays_are_removed() {
        let words = written();
        let initialised = |words: &[u32]| instructions(words, op::VARIABLE).iter().filter(|v| v.len() == 5).count();
        assert_eq!(initialised(&words), 5);
        // The table has values, the short array is one scalar short.
        let out = without_zeros(&words, 24);
        assert_eq!(initialised(&out), 2);
        assert_eq!(out.len(), words.len() - 3);
        assert_eq!(initialised(&without_zeros(&words, 23)), 1);
        assert_eq!(without_zeros(&words, 25), words);
    }

    #[test]
    fn bindings_are_numbered_as_in_wgpu() {
        const DECORATE: u32 = 71;
        const BINDING: u32 = 33;
        let decorations = instructions(&written(), DECORATE);
        let bindings: Vec<u32> = decorations.iter().filter(|d| d[2] == BINDING).map(|d| d[3]).collect();
        // 7 is the second of 2, 7 and 9.
        assert_eq!(bindings, [1]);
    }
}
