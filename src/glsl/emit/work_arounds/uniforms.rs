//! Makes uniforms look like per-pixel values: Mesa's lavapipe recompiles a program for every frame, and keeps the
//! result, where a branch depends only on uniforms (`lvp_inline_uniforms.c`).
//!
//! Each is read once, at the start of its function: one more operation in a loop or branch can keep the driver from
//! unrolling it, or from turning it into a select.

use rustc_hash::FxHashMap;

use crate::{
    ir::{
        GlobalId, GlobalKind, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    types::{Scalar, Type, TypeId},
};

pub(super) fn run(program: &mut Module) {
    rewrite::each_function(program, Uniforms::default);
}

/// Uniforms that were read at the start: the members and indices of the access, and the value.
#[derive(Default)]
struct Uniforms(FxHashMap<(GlobalId, Vec<u32>), Value>);

impl Rule for Uniforms {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        let Op::Load { place } = *op else { return None };
        let root = r.f.root(place);
        let Op::Global(global) = r.f[root] else { return None };
        if !matches!(
            r.module[global].kind,
            GlobalKind::Uniform(_) | GlobalKind::CustomUniform(_) | GlobalKind::Member { .. }
        ) {
            return None;
        }
        let ty = r.f.ty(value);
        let Some(path) = constant_path(r, place) else { return Some(load(r, place, ty)) };
        let key = (global, path);
        if let Some(&made) = self.0.get(&key) {
            return Some(made);
        }
        let made = r.at_start(|r| {
            let place = key.1.iter().fold(root, |base, &index| r.add(Op::Part { base, index }));
            load(r, place, ty)
        });
        self.0.insert(key, made);
        Some(made)
    }
}

/// Returns the members and constant indices of the access to a place.
fn constant_path(r: &Rewriter<'_>, mut place: Value) -> Option<Vec<u32>> {
    let mut path = Vec::new();
    loop {
        match r.f[place] {
            Op::Part { base, index } => {
                path.push(index);
                place = base;
            }
            Op::Element { .. } => return None,
            _ => break,
        }
    }
    path.reverse();
    Some(path)
}

/// Loads the contents of a place in a way that is opaque to the driver.
fn load(r: &mut Rewriter<'_>, place: Value, ty: TypeId) -> Value {
    if !matches!(r.module.types.get(ty), Type::Array { .. } | Type::Matrix { .. } | Type::Struct(_)) {
        let value = r.add_typed(Op::Load { place }, ty);
        // A bool is computed from a number, which is already opaque.
        return if r.module.types.scalar(ty) == Some(Scalar::Bool) { value } else { r.opaque(value) };
    }
    let parts = (0..r.module.extent(ty)).map(|index| {
        let part = r.add(Op::Part { base: place, index });
        load(r, part, r.module.part(ty, index))
    });
    let parts = parts.collect();
    r.add_typed(Op::Compose { ty, parts }, ty)
}
