//! Names of parts of variables, in GLSL syntax: `hit.n.y`, `m[1]`, `dist()`.

use super::flow::Shown;
use eddy_glsl::{
    types::{Type, TypeId},
    walk,
    walkable::{UnsetKind, Walkable},
};
use std::collections::BTreeSet;

/// The limit of parts that are listed for one variable.
const MAX_PARTS: usize = 8;

/// Returns the largest parts of a declaration that its shown scalars fill.
pub(super) fn names(walkable: &Walkable, shown: &Shown) -> String {
    let call = if shown.origin.kind == UnsetKind::Result { "()" } else { "" };
    let mut parts = Vec::new();
    add(walkable, shown.origin.ty, &shown.cells, 0, &format!("{}{call}", shown.origin.name), &mut parts);
    if parts.len() > MAX_PARTS {
        parts.truncate(MAX_PARTS);
        parts.push("…".into());
    }
    parts.join(", ")
}

fn add(walkable: &Walkable, ty: TypeId, cells: &BTreeSet<u32>, start: u32, name: &str, out: &mut Vec<String>) {
    let module = &walkable.program;
    let count = walk::cells(module, ty) as u32;
    match cells.range(start..start + count).count() as u32 {
        0 => return,
        there if there == count => return out.push(name.to_owned()),
        _ => {}
    }
    let mut at = start;
    for index in 0..module.extent(ty) {
        if out.len() > MAX_PARTS {
            return;
        }
        let part = match module.types.get(ty) {
            Type::Struct(id) => format!("{name}.{}", walkable.member_name(id, index)),
            Type::Vector { .. } => format!("{name}.{}", ["x", "y", "z", "w"][index as usize % 4]),
            _ => format!("{name}[{index}]"),
        };
        let ty = module.part(ty, index);
        add(walkable, ty, cells, at, &part, out);
        at += walk::cells(module, ty) as u32;
    }
}
