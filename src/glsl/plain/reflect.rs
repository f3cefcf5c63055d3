//! Reflection: the inputs, outputs and resources of a plain shader.

use super::{ShaderVariable, TextureBinding, UniformMember, std140};
use crate::{
    ast::{BasicType, Interner},
    hir::{self, GlobalId},
    ir::{self, BlockMember},
    types::{Scalar, Type, TypeId},
};

/// Returns an input or output.
pub(crate) fn variable(module: &hir::Module, names: &Interner, id: GlobalId, location: u32) -> ShaderVariable {
    let global = &module[id];
    let name = names.get(global.name.symbol).to_owned();
    ShaderVariable { name, ty: module.type_text(names, global.ty), location, flat: global.flat }
}

/// Returns the description of a sampler, initially unused.
pub(crate) fn texture(texture: &ir::Texture) -> TextureBinding {
    let kind = match texture.scalar {
        Scalar::Int => "i",
        Scalar::Uint => "u",
        _ => "",
    };
    let shadow = if texture.shadow { "Shadow" } else { "" };
    TextureBinding {
        name: texture.name.clone(),
        ty: format!("{kind}sampler{}{shadow}", texture.dim.name()),
        group: texture.group,
        texture_binding: texture.binding,
        sampler_binding: texture.binding + 1,
        used: Default::default(),
    }
}

/// Adds the flattened members of a buffer's member at `offset`.
pub(crate) fn members(program: &ir::Module, member: &BlockMember, offset: u32, out: &mut Vec<UniformMember>) {
    add(program, member.name.clone(), member.ty, offset, out);
}

fn add(program: &ir::Module, name: String, ty: TypeId, offset: u32, out: &mut Vec<UniformMember>) {
    match program.types.get(ty) {
        Type::Struct(id) => {
            let types = &program.structs[id.index()];
            let (offsets, _) = std140::offsets(program, types);
            for ((&ty, at), member) in types.iter().zip(offsets).zip(&program.struct_names[id.index()].members) {
                add(program, format!("{name}.{member}"), ty, offset + at, out);
            }
        }
        Type::Array { element, len } if matches!(program.types.get(element), Type::Struct(_) | Type::Array { .. }) => {
            let stride = std140::array_stride(program, element);
            (0..len).for_each(|i| add(program, format!("{name}[{i}]"), element, offset + i * stride, out));
        }
        _ => {
            let array_stride = match program.types.get(ty) {
                Type::Array { element, .. } => std140::array_stride(program, element),
                _ => 0,
            };
            let size = std140::layout(program, ty).size;
            out.push(UniformMember { name, ty: type_text(program, ty), offset, size, array_stride });
        }
    }
}

/// Returns a type as GLSL writes it.
fn type_text(program: &ir::Module, ty: TypeId) -> String {
    match program.types.get(ty) {
        Type::Array { element, len } => format!("{}[{len}]", type_text(program, element)),
        _ => ty.as_basic().map_or("?", BasicType::name).to_owned(),
    }
}
