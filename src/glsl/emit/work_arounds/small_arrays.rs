//! Small arrays that are constructed at once and then read with a varying index, as `vec2[](a, b, c)[i]`: each read
//! selects among the elements.
//!
//! Mesa's gallivm keeps an indexed array in memory, and stores to it pixel by pixel, with a branch for each
//! (`emit_mask_scatter` in `lp_bld_nir_soa.c`): six elements of two floats are 96 branches. Comparing the index with
//! each position needs none. Mesa's GLSL compiler turns such arrays into if-ladders or uniforms
//! (`lower_const_arrays_to_uniforms.cpp`); nothing does so for SPIR-V.

use rustc_hash::FxHashMap;

use crate::{
    ir::{
        Binary, Block, Function, Module, Op, Stmt, Value, VarId,
        rewrite::{self, Rewriter, Rule},
    },
    types::Type,
};

/// The maximum number of elements of such an array.
const MAX_ELEMENTS: usize = 8;

/// The maximum number of selects for all reads of an array together, so that the code does not grow out of proportion.
const MAX_SELECTS: usize = 64;

pub(super) fn run(program: &mut Module) {
    for index in 0..program.functions.len() {
        let arrays = Arrays::of(program, &program.functions[index]);
        if arrays.is_empty() {
            continue;
        }
        let mut body = std::mem::take(&mut program.functions[index].body);
        drop_stores(&program.functions[index], &mut body, &arrays);
        program.functions[index].body = body;
        rewrite::function(program, index, &mut Choices { arrays });
    }
}

/// A store that fills an array, and the reads of its elements.
#[derive(Default)]
struct Array {
    elements: Option<Box<[Value]>>,
    reads: usize,
    /// The array is used in another way, or may be read before it is filled.
    is_disqualified: bool,
}

struct Arrays<'a> {
    f: &'a Function,
    arrays: FxHashMap<VarId, Array>,
    /// The arrays that are filled at the current statement.
    filled: Vec<VarId>,
}

impl Arrays<'_> {
    /// Returns the elements of each array that is filled once, before every read of an element.
    fn of(program: &Module, f: &Function) -> FxHashMap<VarId, Box<[Value]>> {
        let is_array = |ty| match program.types.get(ty) {
            Type::Array { element, len } => {
                len as usize <= MAX_ELEMENTS
                    && matches!(program.types.get(element), Type::Scalar(_) | Type::Vector { .. })
            }
            _ => false,
        };
        let vars = f.vars.iter().enumerate().filter(|(_, var)| var.init.is_none() && is_array(var.ty));
        let arrays: FxHashMap<VarId, Array> = vars.map(|(var, _)| (VarId::new(var), Array::default())).collect();
        if arrays.is_empty() {
            return FxHashMap::default();
        }
        let mut walk = Arrays { f, arrays, filled: Vec::new() };
        walk.block(&f.body);
        let is_worth = |array: &Array, len: usize| {
            !array.is_disqualified && array.reads > 0 && array.reads * (len - 1) <= MAX_SELECTS
        };
        let arrays = walk.arrays.into_iter();
        arrays
            .filter_map(|(var, array)| {
                array.elements.clone().filter(|it| is_worth(&array, it.len())).map(|it| (var, it))
            })
            .collect()
    }

    fn block(&mut self, block: &Block) {
        let filled = self.filled.len();
        for stmt in block {
            match stmt {
                Stmt::Let(value) => match &self.f[*value] {
                    Op::Load { place } => self.load(*place),
                    Op::Call { args, .. } => args.iter().for_each(|&arg| self.disqualify(arg)),
                    _ => {}
                },
                Stmt::Store { place, value } => self.store(*place, *value),
                _ => stmt.blocks(|block| self.block(block)),
            }
        }
        self.filled.truncate(filled);
    }

    fn array(&mut self, place: Value) -> Option<(VarId, &mut Array)> {
        match self.f[self.f.root(place)] {
            Op::Var(var) => self.arrays.get_mut(&var).map(|array| (var, array)),
            _ => None,
        }
    }

    fn disqualify(&mut self, place: Value) {
        if let Some((_, array)) = self.array(place) {
            array.is_disqualified = true;
        }
    }

    fn store(&mut self, place: Value, value: Value) {
        let f = self.f;
        let Some((var, array)) = self.array(place) else { return };
        match (&f[place], &f[value]) {
            (Op::Var(_), Op::Compose { parts, .. }) if array.elements.is_none() => {
                array.elements = Some(parts.clone());
                self.filled.push(var);
            }
            _ => array.is_disqualified = true,
        }
    }

    fn load(&mut self, place: Value) {
        let is_element = element(self.f, place).is_some();
        let filled = std::mem::take(&mut self.filled);
        if let Some((var, array)) = self.array(place) {
            array.is_disqualified |= !is_element || !filled.contains(&var);
            array.reads += 1;
        }
        self.filled = filled;
    }
}

/// Returns the array, the index and the component of a place that is an element of a variable or one of its components.
fn element(f: &Function, place: Value) -> Option<(VarId, Value, Option<u32>)> {
    let of = |place: Value| match f[place] {
        Op::Element { base, index } => match f[base] {
            Op::Var(var) => Some((var, index)),
            _ => None,
        },
        _ => None,
    };
    match f[place] {
        Op::Part { base, index: component } => of(base).map(|(var, index)| (var, index, Some(component))),
        _ => of(place).map(|(var, index)| (var, index, None)),
    }
}

fn drop_stores(f: &Function, block: &mut Block, arrays: &FxHashMap<VarId, Box<[Value]>>) {
    block.retain(|stmt| !matches!(stmt, Stmt::Store { place, .. } if matches!(f[*place], Op::Var(var) if arrays.contains_key(&var))));
    block.iter_mut().for_each(|stmt| stmt.blocks_mut(|block| drop_stores(f, block, arrays)));
}

struct Choices {
    arrays: FxHashMap<VarId, Box<[Value]>>,
}

impl Rule for Choices {
    fn operation(&mut self, r: &mut Rewriter<'_>, _: Value, op: &Op) -> Option<Value> {
        let Op::Load { place } = *op else { return None };
        let (var, index, component) = element(&r.f, place)?;
        let elements = self.arrays.get(&var)?.clone();
        let scalar = r.module.scalar(r.f.ty(index));
        let part = |r: &mut Rewriter<'_>, element: Value| {
            let base = r.value(element);
            component.map_or(base, |index| r.add(Op::Part { base, index }))
        };
        let (&last, others) = elements.split_last()?;
        let mut chosen = part(r, last);
        for (number, &other) in others.iter().enumerate().rev() {
            let accept = part(r, other);
            let number = r.literal(scalar, number as u32);
            let condition = r.add(Op::Binary { op: Binary::Equal, left: index, right: number });
            chosen = r.add(Op::Select { condition, accept, reject: chosen });
        }
        Some(chosen)
    }
}
