//! Assigns bindings to the uniforms and samplers of a plain shader.

use super::PlainOptions;
use crate::{
    ast::{Interner, Symbol},
    hir::{GlobalId, GlobalStorage, Module, Type, TypeId},
    ir::{BlockMember, StructNames, Texture, UniformBlock},
};
use rustc_hash::FxHashMap;

/// The resources of a plain shader.
#[derive(Clone, Debug, Default)]
pub(crate) struct Resources {
    /// In the order of [`Module::samplers`].
    pub textures: Vec<Texture>,
    pub blocks: Vec<UniformBlock>,
    /// The block of each uniform, and its index among the members.
    pub members: FxHashMap<GlobalId, (u16, u16)>,
    /// The names of structures, by [`StructId::index`](crate::types::StructId::index).
    pub struct_names: Vec<StructNames>,
}

/// Assigns a binding to each uniform and sampler, whether it is used or not.
pub(crate) fn resources(module: &Module, names: &Interner, options: PlainOptions) -> Resources {
    let group = options.group;
    let mut made = Resources { struct_names: struct_names(module, names), ..Resources::default() };
    made.blocks.push(UniformBlock { name: String::new(), group, binding: 0, members: Vec::new() });
    let mut blocks: FxHashMap<Symbol, usize> = FxHashMap::default();
    let mut next = 1;
    for (index, global) in module.globals.iter().enumerate() {
        if global.storage != GlobalStorage::Uniform || global.value.is_some() || global.ty == TypeId::ERROR {
            continue;
        }
        let name = names.get(global.name.symbol).to_owned();
        if let Type::Sampler { dim, scalar, shadow } = module.types.get(global.ty) {
            made.textures.push(Texture { name, dim, scalar, shadow, group, binding: next });
            next += 2;
            continue;
        }
        let block = match global.block {
            None => 0,
            Some(block) => *blocks.entry(block).or_insert_with(|| {
                let name = names.get(block).to_owned();
                made.blocks.push(UniformBlock { name, group, binding: next, members: Vec::new() });
                next += 1;
                made.blocks.len() - 1
            }),
        };
        let members = &mut made.blocks[block].members;
        made.members.insert(GlobalId::new(index), (block as u16, members.len() as u16));
        members.push(BlockMember { name, ty: global.ty });
    }
    made
}

fn struct_names(module: &Module, names: &Interner) -> Vec<StructNames> {
    let of = |structure: &crate::hir::Struct| StructNames {
        name: structure.name.map(|name| names.get(name.symbol).to_owned()).unwrap_or_default(),
        members: module[structure.members].iter().map(|m| names.get(m.name.symbol).to_owned()).collect(),
    };
    module.structs.iter().map(of).collect()
}
