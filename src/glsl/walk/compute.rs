//! Operations: what a value is computed from, in one lane.

use super::{
    layout, math,
    number::{Cell, Real},
    state::{Frame, LANES, State},
    world::Lod,
};
use crate::glsl::{
    ir::{Axis, Binary, Level, Math, Op, Value},
    types::Scalar,
};

impl<R: Real> State<'_, R> {
    /// The address of a part of a place in each lane.
    pub fn part_of_place(&self, frame: &Frame<R>, op: &Op) -> [u32; LANES] {
        let function = &self.module[frame.function];
        match *op {
            Op::Part { base, index } => {
                let offset = layout::offset(self.module, function.ty(base), index) as u32;
                self.place(frame, base).map(|start| start + offset)
            }
            Op::Element { base, index } => {
                let size = layout::cells(self.module, self.module.part(function.ty(base), 0)) as u32;
                let count = self.module.extent(function.ty(base));
                let starts = self.place(frame, base);
                std::array::from_fn(|lane| {
                    let index = self.value(frame, index, lane)[0].bits().min(count - 1);
                    starts[lane] + index * size
                })
            }
            ref other => unreachable!("{other:?} is no part of a place"),
        }
    }

    /// An operation on values of one lane.
    pub fn pure(&self, frame: &Frame<R>, value: Value, op: &Op, lane: usize, out: &mut Vec<Cell<R>>) {
        let function = &self.module[frame.function];
        let cells = |value: Value| self.value(frame, value, lane);
        let ty = |value: Value| function.ty(value);
        let scalar = |value: Value| self.module.types.scalar(function.ty(value)).unwrap_or(Scalar::Float);
        let int = |value: Value| cells(value)[0].bits() as i32;
        match *op {
            Op::Part { base, index } => {
                let start = layout::offset(self.module, ty(base), index);
                let size = layout::cells(self.module, ty(value));
                out.extend_from_slice(&cells(base)[start..start + size]);
            }
            Op::Element { base, index } => {
                let size = layout::cells(self.module, ty(value));
                let last = cells(base).len() / size - 1;
                let start = size * (cells(index)[0].bits() as usize).min(last);
                out.extend_from_slice(&cells(base)[start..start + size]);
            }
            Op::Swizzle { vector, swizzle } => out.extend(swizzle.iter().map(|i| cells(vector)[i])),
            Op::Splat { size, value } => out.resize(size.into(), cells(value)[0]),
            Op::Compose { ref parts, .. } => parts.iter().for_each(|&part| out.extend_from_slice(cells(part))),
            Op::Unary { op, operand } => out.extend(cells(operand).iter().map(|&cell| math::unary(op, cell))),
            Op::Binary { op, left, right } => {
                let scalar = scalar(left);
                let is_product = op == Binary::Multiply && scalar == Scalar::Float;
                let [is_left_known, is_right_known] =
                    [left, right].map(|value| is_product && self.is_constant(frame, value));
                let (left, right) = (cells(left), cells(right));
                let size = left.len().max(right.len());
                // A scalar meets each component of the other side.
                let at = |cells: &[Cell<R>], i: usize| if cells.len() == 1 { cells[0] } else { cells[i] };
                let zero = R::from_f64(0.0);
                out.extend((0..size).map(|i| match (at(left, i), at(right, i)) {
                    // Drivers drop a product with a zero that they see, also one with infinity (`nir_opt_algebraic.py`):
                    // `mod(x, 0.0)` is x.
                    (left, _) if is_left_known && left.float() == zero => Cell::Float(zero),
                    (_, right) if is_right_known && right.float() == zero => Cell::Float(zero),
                    (left, right) => math::binary(op, scalar, left, right),
                }));
            }
            Op::Math { fun, arg, arg1, arg2, arg3 } => {
                let args: Vec<&[Cell<R>]> = [Some(arg), arg1, arg2, arg3].into_iter().flatten().map(cells).collect();
                math::function(fun, self.module.types.get(ty(arg)), scalar(arg), &args, out);
            }
            Op::Select { condition, accept, reject } => {
                let (condition, accept, reject) = (cells(condition), cells(accept), cells(reject));
                let is_true = |i: usize| condition[if condition.len() == 1 { 0 } else { i }].is_true();
                out.extend((0..accept.len()).map(|i| if is_true(i) { accept[i] } else { reject[i] }));
            }
            Op::Convert { value, to } => {
                let from = scalar(value);
                out.extend(cells(value).iter().map(|&cell| math::convert(cell, from, to)));
            }
            Op::Bitcast { value, to } => out.extend(cells(value).iter().map(|&cell| math::bitcast(cell, to))),
            Op::All(value) => out.push(cells(value).iter().all(|cell| cell.is_true()).into()),
            Op::Any(value) => out.push(cells(value).iter().any(|cell| cell.is_true()).into()),
            Op::Fetch { channel, coordinate, level } => {
                let mut at = [0; 3];
                at.iter_mut().zip(cells(coordinate)).for_each(|(at, cell)| *at = cell.bits() as i32);
                let texel = self.world.fetch(channel, at, int(level));
                out.extend(texel.map(|number| Cell::Float(R::from_f64(number.into()))));
            }
            Op::TextureSize { channel, level } => {
                let size = self.world.size(channel, level.map_or(0, int));
                let count = layout::cells(self.module, ty(value));
                out.extend(size[..count].iter().map(|&n| Cell::Bits(n as u32)));
            }
            Op::TextureLevels { channel } => out.push(Cell::Bits(self.world.levels(channel))),
            Op::Load { place } => out.extend_from_slice(self.memory(frame, place, lane)),
            Op::OpaqueZero => out.push(Cell::Bits(0)),
            ref other => unreachable!("{other:?} is computed elsewhere"),
        }
    }

    /// The lanes whose difference is a derivative along x or y, in the row or column of a lane.
    fn neighbours(axis: Axis, lane: usize) -> (usize, usize) {
        match axis {
            Axis::Y => (lane & 1, lane & 1 | 2),
            _ => (lane & 2, lane & 2 | 1),
        }
    }

    fn difference(&self, frame: &Frame<R>, axis: Axis, value: Value, lane: usize) -> Vec<R> {
        let (from, to) = Self::neighbours(axis, lane);
        let (from, to) = (self.value(frame, value, from), self.value(frame, value, to));
        to.iter().zip(from).map(|(to, from)| to.float() - from.float()).collect()
    }

    pub fn derivative(&self, frame: &Frame<R>, axis: Axis, value: Value, lane: usize, out: &mut Vec<Cell<R>>) {
        match axis {
            Axis::X | Axis::Y => {
                out.extend(self.difference(frame, axis, value, lane).into_iter().map(Cell::Float));
            }
            Axis::Width => {
                let [x, y] = [Axis::X, Axis::Y].map(|axis| self.difference(frame, axis, value, lane));
                let sum = |(x, y): (R, R)| Cell::Float(x.unary(Math::Abs) + y.unary(Math::Abs));
                out.extend(x.into_iter().zip(y).map(sum));
            }
        }
    }

    pub fn sample(
        &self,
        frame: &Frame<R>,
        (channel, coordinate, level, offset): (u8, Value, Level, Option<Value>),
        lane: usize,
        out: &mut Vec<Cell<R>>,
    ) {
        let mut texels = [0; 3];
        if let Some(offset) = offset {
            let cells = self.value(frame, offset, lane);
            texels.iter_mut().zip(cells).for_each(|(n, cell)| *n = cell.bits() as i32);
        }
        let read = |number: fn(R) -> f64| {
            let vector = |value: Value| {
                let mut at = [0.0; 3];
                let cells = self.value(frame, value, lane);
                at.iter_mut().zip(cells).for_each(|(at, cell)| *at = number(cell.float()));
                at
            };
            let difference = |axis| {
                let mut at = [0.0; 3];
                let changes = self.difference(frame, axis, coordinate, lane);
                at.iter_mut().zip(changes).for_each(|(at, change)| *at = number(change));
                at
            };
            let implicit = |bias| Lod::Derivatives { x: difference(Axis::X), y: difference(Axis::Y), bias };
            let lod = match level {
                Level::Auto => implicit(0.0),
                Level::Bias(bias) => implicit(vector(bias)[0]),
                Level::Exact(level) => Lod::Exact(vector(level)[0]),
                Level::Gradient { x, y } => Lod::Derivatives { x: vector(x), y: vector(y), bias: 0.0 },
            };
            self.world.sample(channel, vector(coordinate), lod, texels)
        };
        let texel = read(R::to_f64);
        let shadow = if R::IS_SHADOWED { read(R::shadow) } else { texel };
        out.extend(texel.iter().zip(shadow).map(|(texel, shadow)| Cell::Float(R::with_shadow(*texel, shadow))));
    }
}
