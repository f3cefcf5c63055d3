//! Dependencies of each scalar of a result on those of its operands.

use super::Flow;
use super::sets::{Set, Sets};
use eddy_glsl::{
    ir::{Math, Op, Value},
    types::Type,
    walk::{Shadowed, View},
};

impl Flow<'_> {
    /// Records the dependencies of a computed value.
    pub(crate) fn value(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        let op = view.op(value);
        let out = view.cells_of(value);
        let Some(frame) = self.frames.last_mut() else { return };
        let sets = &mut self.sets;
        let super::Frame { cells, places, .. } = frame;
        match *op {
            Op::Part { base, .. } => {
                let from = view.cells_of(base).start + view.offset(value);
                (0..out.len()).for_each(|i| cells[out.start + i] = cells[from + i]);
            }
            Op::Element { base, index } => {
                let (base, decides) = (view.cells_of(base), cells[view.cells_of(index).start]);
                for i in 0..out.len() {
                    cells[out.start + i] = if decides.is_empty() {
                        let last = base.len() / out.len() - 1;
                        let at = (view.value(index)[0].bits() as usize).min(last);
                        cells[base.start + at * out.len() + i]
                    } else {
                        let any = all(sets, &cells[base.clone()]);
                        sets.union(any, decides)
                    };
                }
            }
            Op::Swizzle { vector, swizzle } => {
                let from = view.cells_of(vector).start;
                for (i, component) in swizzle.iter().enumerate() {
                    cells[out.start + i] = cells[from + component];
                }
            }
            Op::Splat { value, .. } => {
                let set = cells[view.cells_of(value).start];
                cells[out].fill(set);
            }
            Op::Compose { ref parts, .. } => {
                let mut to = out.start;
                for &part in &**parts {
                    for from in view.cells_of(part) {
                        cells[to] = cells[from];
                        to += 1;
                    }
                }
            }
            Op::Select { condition, accept, reject } => {
                let condition_cells = view.cells_of(condition);
                let by = usize::from(condition_cells.len() > 1);
                for i in 0..out.len() {
                    let chosen = if view.value(condition)[i * by].is_true() { accept } else { reject };
                    let chosen = cells[view.cells_of(chosen).start + i];
                    cells[out.start + i] = sets.union(cells[condition_cells.start + i * by], chosen);
                }
            }
            Op::Math { fun: Math::Cross, arg, arg1: Some(other), .. } => {
                let (a, b) = (view.cells_of(arg).start, view.cells_of(other).start);
                for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
                    let read = [cells[a + j], cells[a + k], cells[b + j], cells[b + k]];
                    cells[out.start + i] = all(sets, &read);
                }
            }
            Op::Math { fun: Math::Transpose, arg, .. } => {
                let from = view.cells_of(arg).start;
                if let Type::Matrix { columns, rows } = view.module().types.get(view.function().ty(arg)) {
                    let (columns, rows) = (usize::from(columns), usize::from(rows));
                    for (r, c) in (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))) {
                        cells[out.start + r * columns + c] = cells[from + c * rows + r];
                    }
                }
            }
            Op::Math { fun: Math::FaceForward, arg, arg1: Some(i), arg2: Some(n), .. } => {
                let decides = [all(sets, &cells[view.cells_of(i)]), all(sets, &cells[view.cells_of(n)])];
                let (decides, from) = (all(sets, &decides), view.cells_of(arg).start);
                for i in 0..out.len() {
                    cells[out.start + i] = sets.union(cells[from + i], decides);
                }
            }
            Op::Load { place } => {
                let through = places.get(&place).map_or(Set::EMPTY, |known| known.0);
                let start = view.address(place);
                for i in 0..out.len() {
                    let held = self.memory.get(start + i).copied().unwrap_or_default();
                    cells[out.start + i] = sets.union(held, through);
                }
            }
            Op::Call { .. } => {
                for i in 0..out.len() {
                    cells[out.start + i] = self.returned.get(i).copied().unwrap_or_default();
                }
            }
            Op::Unary { .. } | Op::Binary { .. } | Op::Convert { .. } | Op::Bitcast { .. } | Op::Derivative { .. } => {
                by_component(view, op, out, cells, sets);
            }
            Op::Math { fun, .. } if fun.is_componentwise() => by_component(view, op, out, cells, sets),
            // Each scalar of the result depends on all operands.
            _ => {
                let mut read = Set::EMPTY;
                op.operands(|operand| {
                    let of_operand = all(sets, &cells[view.cells_of(operand)]);
                    read = sets.union(read, of_operand);
                });
                cells[out].fill(read);
            }
        }
    }
}

/// A scalar is combined with each component of the other operands.
fn by_component(
    view: &View<'_, '_, Shadowed>,
    op: &Op,
    out: std::ops::Range<usize>,
    cells: &mut [Set],
    sets: &mut Sets,
) {
    cells[out.clone()].fill(Set::EMPTY);
    op.operands(|operand| {
        let from = view.cells_of(operand);
        let by = usize::from(from.len() > 1);
        for i in 0..out.len() {
            cells[out.start + i] = sets.union(cells[out.start + i], cells[from.start + i * by]);
        }
    });
}

pub(super) fn all(sets: &mut Sets, of: &[Set]) -> Set {
    of.iter().fold(Set::EMPTY, |all, &set| sets.union(all, set))
}
