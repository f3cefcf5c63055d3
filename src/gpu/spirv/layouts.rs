//! Types without a memory layout for the variables of an invocation.
//!
//! naga's writer declares each structure and array once, with the offsets and strides that it has in buffers, and uses
//! that type for variables of the storage classes Function, Private and Workgroup too. The Vulkan specification allows
//! these decorations only in classes with an explicit layout ("Shader Interfaces", VUID-StandaloneSpirv-None-10684);
//! up to SPIR-V 1.4 also in Function and Private, but wgpu writes the newest version that a driver reads. Most drivers
//! ignore them; NVIDIA's 580.76 has crashed on them (Genesis-Embodied-AI/quadrants, pull request 548).
//!
//! Here a type that is used for values loses them. If buffers use it as well, they get a type of their own that has
//! them, and a value that is read or written as a whole is taken apart and composed as the other type: `OpCopyLogical`
//! would do this in one instruction, but SPIR-V 1.0 does not have it, and Mesa loads structures and arrays part by part
//! in any case.

use std::collections::{HashMap, HashSet};

use super::words::{BOUND, HEADER, class, decoration, instructions, op, push};

/// A type with parts. Vectors and matrices have no layout of their own.
enum Composite<'a> {
    /// `None` is the length of a runtime array.
    Array(u32, Option<u32>),
    Struct(&'a [u32]),
}

impl Composite<'_> {
    /// Returns the type of each part; that of a runtime array only once.
    fn parts(&self) -> Box<dyn Iterator<Item = u32> + '_> {
        match *self {
            Composite::Array(element, len) => Box::new(std::iter::repeat_n(element, len.unwrap_or(1) as usize)),
            Composite::Struct(members) => Box::new(members.iter().copied()),
        }
    }
}

/// The types of a module by their use.
struct Types<'a> {
    composites: HashMap<u32, Composite<'a>>,
    /// Types of values and of variables without an explicit layout.
    values: HashSet<u32>,
    /// New types with the layout of each type that both values and buffers use.
    laid_out: HashMap<u32, u32>,
    /// The types that pointers into buffers point to, by the id of the pointer's type.
    in_buffers: HashMap<u32, u32>,
}

/// Gives values and variables of the module's own types without layout decorations. `None` if the module has arrays
/// whose lengths are specialization constants, or parts that are too many for one instruction.
pub(super) fn without_layouts(words: &[u32]) -> Option<Vec<u32>> {
    let types = Types::of(words)?;
    let mut out = words[..HEADER].to_vec();
    let mut copier = Copier { types: &types, bound: words[BOUND] + types.laid_out.len() as u32 };
    // The types of pointers into buffers, by the pointer.
    let mut pointers = HashMap::new();
    for (operation, instruction) in instructions(words) {
        let laid_out = |id: u32| types.laid_out.get(&id).copied().unwrap_or(id);
        match (operation, &instruction[1..]) {
            (
                op::VARIABLE | op::FUNCTION_PARAMETER | op::ACCESS_CHAIN | op::IN_BOUNDS_ACCESS_CHAIN,
                [pointer, id, ..],
            ) => {
                if let Some(&pointee) = types.in_buffers.get(pointer) {
                    pointers.insert(*id, pointee);
                }
            }
            (op::DECORATE, &[ty, decoration, ..]) if types.composites.contains_key(&ty) => {
                if types.laid_out.contains_key(&ty)
                    || decoration != decoration::ARRAY_STRIDE
                    || !types.values.contains(&ty)
                {
                    push(&mut out, op::DECORATE, [laid_out(ty)].into_iter().chain(instruction[2..].iter().copied()))?;
                }
                continue;
            }
            (op::MEMBER_DECORATE, &[ty, _, decoration, ..]) if is_layout(decoration) => {
                if types.laid_out.contains_key(&ty) || !types.values.contains(&ty) {
                    let rest = instruction[2..].iter().copied();
                    push(&mut out, op::MEMBER_DECORATE, [laid_out(ty)].into_iter().chain(rest))?;
                }
                continue;
            }
            (op::TYPE_POINTER, &[id, class, pointee]) if is_explicit(class) => {
                push(&mut out, op::TYPE_POINTER, [id, class, laid_out(pointee)])?;
                continue;
            }
            (op::TYPE_ARRAY | op::TYPE_RUNTIME_ARRAY | op::TYPE_STRUCT, &[id, ref parts @ ..]) => {
                if types.values.contains(&id) {
                    out.extend_from_slice(instruction);
                }
                if types.laid_out.contains_key(&id) || !types.values.contains(&id) {
                    // An array's length is no type, so `laid_out` leaves it unchanged.
                    let parts = parts.iter().map(|&part| laid_out(part));
                    push(&mut out, operation, [laid_out(id)].into_iter().chain(parts))?;
                }
                continue;
            }
            (op::LOAD, &[ty, id, pointer, ref access @ ..])
                if types.laid_out.contains_key(&ty) && pointers.contains_key(&pointer) =>
            {
                let loaded = copier.id();
                push(&mut out, op::LOAD, [laid_out(ty), loaded, pointer].into_iter().chain(access.iter().copied()))?;
                copier.copy(&mut out, ty, (loaded, Copy::FromBuffer), Some(id))?;
                continue;
            }
            (op::STORE, &[pointer, value, ref access @ ..]) => {
                if let Some(&ty) = pointers.get(&pointer).filter(|ty| types.laid_out.contains_key(ty)) {
                    let value = copier.copy(&mut out, ty, (value, Copy::ToBuffer), None)?;
                    push(&mut out, op::STORE, [pointer, value].into_iter().chain(access.iter().copied()))?;
                    continue;
                }
            }
            _ => {}
        }
        out.extend_from_slice(instruction);
    }
    out[BOUND] = copier.bound;
    Some(out)
}

/// Returns whether variables of a storage class have an explicit layout.
fn is_explicit(class: u32) -> bool {
    matches!(class, class::UNIFORM | class::STORAGE_BUFFER | class::PUSH_CONSTANT)
}

/// Returns whether a decoration of a member is part of a layout.
fn is_layout(decoration: u32) -> bool {
    use decoration::{COLUMN_MAJOR, MATRIX_STRIDE, OFFSET, ROW_MAJOR};
    matches!(decoration, OFFSET | MATRIX_STRIDE | COLUMN_MAJOR | ROW_MAJOR)
}

impl<'a> Types<'a> {
    fn of(words: &'a [u32]) -> Option<Self> {
        let mut composites = HashMap::new();
        let mut constants = HashMap::new();
        let (mut used_by_values, mut used_by_buffers) = (Vec::new(), Vec::new());
        let mut in_buffers = HashMap::new();
        for (operation, instruction) in instructions(words) {
            match (operation, &instruction[1..]) {
                (op::NAME | op::MEMBER_NAME | op::DECORATE | op::MEMBER_DECORATE, _) => {}
                (op::CONSTANT, &[_, id, value]) => _ = constants.insert(id, value),
                (op::TYPE_ARRAY, &[id, element, len]) => {
                    _ = composites.insert(id, Composite::Array(element, Some(*constants.get(&len)?)));
                }
                (op::TYPE_RUNTIME_ARRAY, &[id, element]) => {
                    _ = composites.insert(id, Composite::Array(element, None));
                }
                (op::TYPE_STRUCT, [id, members @ ..]) => _ = composites.insert(*id, Composite::Struct(members)),
                (op::TYPE_POINTER, &[id, class, pointee]) if is_explicit(class) => {
                    in_buffers.insert(id, pointee);
                    used_by_buffers.push(pointee);
                }
                (op::TYPE_POINTER, &[_, _, pointee]) => used_by_values.push(pointee),
                // The result type, if the instruction has one: no other id is that of a type.
                (_, &[ty, ..]) if composites.contains_key(&ty) => used_by_values.push(ty),
                _ => {}
            }
        }
        let reached = |mut from: Vec<u32>| {
            let mut reached = HashSet::new();
            while let Some(ty) = from.pop() {
                if let Some(composite) = composites.get(&ty)
                    && reached.insert(ty)
                {
                    match *composite {
                        Composite::Array(element, _) => from.push(element),
                        Composite::Struct(members) => from.extend(members),
                    }
                }
            }
            reached
        };
        let values = reached(used_by_values);
        let mut both: Vec<u32> = reached(used_by_buffers).intersection(&values).copied().collect();
        both.sort_unstable();
        let laid_out = both.into_iter().zip(words[BOUND]..).collect();
        Some(Self { composites, values, laid_out, in_buffers })
    }
}

#[derive(Clone, Copy)]
enum Copy {
    FromBuffer,
    ToBuffer,
}

/// Writes copies between the two types of a value, and counts their ids.
struct Copier<'a> {
    types: &'a Types<'a>,
    bound: u32,
}

impl Copier<'_> {
    fn id(&mut self) -> u32 {
        self.bound += 1;
        self.bound - 1
    }

    /// Returns the copy of a value, as `result` if that is given. `ty` is the type without a layout.
    fn copy(&mut self, out: &mut Vec<u32>, ty: u32, from: (u32, Copy), result: Option<u32>) -> Option<u32> {
        let types = self.types;
        let (value, direction) = from;
        // The types of the value and of the copy.
        let pair = |ty: u32| {
            let laid_out = types.laid_out.get(&ty).copied().unwrap_or(ty);
            match direction {
                Copy::FromBuffer => (laid_out, ty),
                Copy::ToBuffer => (ty, laid_out),
            }
        };
        let mut parts = Vec::new();
        for (index, part) in (0u32..).zip(types.composites.get(&ty)?.parts()) {
            let extracted = self.id();
            push(out, op::COMPOSITE_EXTRACT, [pair(part).0, extracted, value, index])?;
            parts.push(match types.laid_out.contains_key(&part) {
                true => self.copy(out, part, (extracted, direction), None)?,
                false => extracted,
            });
        }
        let copy = result.unwrap_or_else(|| self.id());
        push(out, op::COMPOSITE_CONSTRUCT, [pair(ty).1, copy].into_iter().chain(parts))?;
        Some(copy)
    }
}
