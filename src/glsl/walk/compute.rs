//! Operations: computing a value from its operands, in the active lanes.

use super::{
    layout::{Slot, SlotKind},
    math,
    number::{Cell, Float},
    state::{Frame, Lanes, State, of},
    world::Lod,
};
use crate::{
    ir::{Axis, Binary, Detail, Level, Math, Op, Value},
    types::Scalar,
};

/// Maps each component of one operand to the cells of the result.
fn map<R: Float>(cells: &mut [Cell<R>], lanes: Lanes, out: Slot, arg: Slot, f: impl Fn(Cell<R>) -> Cell<R>) {
    for lane in of(lanes) {
        let (to, from) = (out.first(lane), arg.first(lane));
        for i in 0..out.size as usize {
            cells[to + i] = f(cells[from + i]);
        }
    }
}

/// As [`map`], with two operands. A scalar is combined with each component of the other side.
fn zip<R: Float>(
    cells: &mut [Cell<R>],
    lanes: Lanes,
    out: Slot,
    (left, right): (Slot, Slot),
    f: impl Fn(Cell<R>, Cell<R>) -> Cell<R>,
) {
    let (by_left, by_right) = (usize::from(left.size > 1), usize::from(right.size > 1));
    for lane in of(lanes) {
        let (to, left, right) = (out.first(lane), left.first(lane), right.first(lane));
        for i in 0..out.size as usize {
            cells[to + i] = f(cells[left + i * by_left], cells[right + i * by_right]);
        }
    }
}

/// Copies a few cells; one by one is faster.
fn copy<R: Float>(cells: &mut [Cell<R>], to: usize, from: usize, count: u32) {
    for i in 0..count as usize {
        cells[to + i] = cells[from + i];
    }
}

/// A product with a factor that is known statically. Drivers drop a product with a known zero, even one with infinity
/// (`nir_opt_algebraic.py`): `mod(x, 0.0)` is x.
fn product<R: Float>(left: (Cell<R>, bool), right: (Cell<R>, bool)) -> Cell<R> {
    let zero = R::from_f64(0.0);
    let is_dropped = |(factor, is_known): (Cell<R>, bool)| is_known && factor.float() == zero;
    if is_dropped(left) || is_dropped(right) {
        return Cell::Float(zero);
    }
    Cell::Float(left.0.float() * right.0.float())
}

impl<R: Float> State<'_, R> {
    /// Computes the address of a part of a place in some lanes.
    pub(super) fn part_of_place(&self, frame: &mut Frame<R>, value: Value, lanes: Lanes) {
        let layout = self.layout(frame);
        let (out, offset) = (layout.slots[value.index()].start as usize, layout.offsets[value.index()]);
        match self.module[frame.function][value] {
            Op::Part { base, .. } => {
                let base = layout.slots[base.index()].start as usize;
                of(lanes).for_each(|lane| frame.places[out][lane] = frame.places[base][lane] + offset);
            }
            Op::Element { base, index } => {
                let (base, index) = (layout.slots[base.index()], layout.slots[index.index()]);
                let last = (base.size / offset.max(1)).max(1) - 1;
                for lane in of(lanes) {
                    let index = frame.cells[index.first(lane)].bits().min(last);
                    frame.places[out][lane] = frame.places[base.start as usize][lane] + index * offset;
                }
            }
            ref other => unreachable!("{other:?} is no part of a place"),
        }
    }

    /// Computes a value in some lanes.
    pub(super) fn compute(&self, frame: &mut Frame<R>, value: Value, lanes: Lanes, scratch: &mut Vec<Cell<R>>) {
        let layout = self.layout(frame);
        let slot = |value: Value| layout.slots[value.index()];
        let out = slot(value);
        let Frame { function, cells, places, .. } = frame;
        match self.module[*function][value] {
            Op::Part { base, .. } => {
                let (base, before) = (slot(base), layout.offsets[value.index()] as usize);
                of(lanes).for_each(|lane| copy(cells, out.first(lane), base.first(lane) + before, out.size));
            }
            Op::Element { base, index } => {
                let (base, index) = (slot(base), slot(index));
                let last = (base.size / out.size) as usize - 1;
                for lane in of(lanes) {
                    let index = (cells[index.first(lane)].bits() as usize).min(last);
                    copy(cells, out.first(lane), base.first(lane) + index * out.size as usize, out.size);
                }
            }
            Op::Swizzle { vector, swizzle } => {
                let vector = slot(vector);
                for lane in of(lanes) {
                    for (i, component) in swizzle.iter().enumerate() {
                        cells[out.first(lane) + i] = cells[vector.first(lane) + component];
                    }
                }
            }
            Op::Splat { value, .. } => {
                let value = slot(value);
                for lane in of(lanes) {
                    let cell = cells[value.first(lane)];
                    cells[out.cells(lane)].fill(cell);
                }
            }
            Op::Compose { ref parts, .. } => {
                let mut before = 0;
                for part in parts {
                    let part = slot(*part);
                    of(lanes).for_each(|lane| copy(cells, out.first(lane) + before, part.first(lane), part.size));
                    before += part.size as usize;
                }
            }
            Op::Unary { op, operand } => map(cells, lanes, out, slot(operand), |cell| math::unary(op, cell)),
            Op::Binary { op, left, right } => {
                let scalar = layout.scalars[left.index()];
                let (is_float, operands) = (scalar == Scalar::Float, (slot(left), slot(right)));
                let is_known = |slot: Slot| slot.kind == SlotKind::Constant;
                match op {
                    Binary::Add if is_float => {
                        zip(cells, lanes, out, operands, |a, b| Cell::Float(a.float() + b.float()));
                    }
                    Binary::Subtract if is_float => {
                        zip(cells, lanes, out, operands, |a, b| Cell::Float(a.float() - b.float()));
                    }
                    Binary::Multiply if is_float && (is_known(operands.0) || is_known(operands.1)) => {
                        let known = (is_known(operands.0), is_known(operands.1));
                        zip(cells, lanes, out, operands, |a, b| product((a, known.0), (b, known.1)));
                    }
                    Binary::Multiply if is_float => {
                        zip(cells, lanes, out, operands, |a, b| Cell::Float(a.float() * b.float()));
                    }
                    _ => zip(cells, lanes, out, operands, |a, b| math::binary(op, scalar, a, b)),
                }
            }
            Op::Math { fun, arg, arg1, arg2, arg3 } => {
                let (scalar, first) = (layout.scalars[arg.index()], slot(arg));
                match (fun, arg1) {
                    (Math::Min, Some(other)) if scalar == Scalar::Float => {
                        let least = |a: Cell<R>, b: Cell<R>| Cell::Float(a.float().binary(Math::Min, b.float()));
                        zip(cells, lanes, out, (first, slot(other)), least);
                    }
                    (Math::Max, Some(other)) if scalar == Scalar::Float => {
                        let largest = |a: Cell<R>, b: Cell<R>| Cell::Float(a.float().binary(Math::Max, b.float()));
                        zip(cells, lanes, out, (first, slot(other)), largest);
                    }
                    (_, None) if scalar == Scalar::Float && fun.is_componentwise() => {
                        map(cells, lanes, out, first, |cell| Cell::Float(cell.float().unary(fun)));
                    }
                    _ => {
                        let ty = self.module.types.get(self.module[*function].ty(arg));
                        for lane in of(lanes) {
                            let (mut args, mut count): ([&[Cell<R>]; 4], usize) = ([&[]; 4], 0);
                            for arg in [Some(arg), arg1, arg2, arg3].into_iter().flatten() {
                                args[count] = &cells[slot(arg).cells(lane)];
                                count += 1;
                            }
                            scratch.clear();
                            math::function(fun, ty, scalar, &args[..count], scratch);
                            cells[out.cells(lane)].copy_from_slice(scratch);
                        }
                    }
                }
            }
            Op::Select { condition, accept, reject } => {
                let (condition, accept, reject) = (slot(condition), slot(accept), slot(reject));
                let by = usize::from(condition.size > 1);
                for lane in of(lanes) {
                    for i in 0..out.size as usize {
                        let is_true = cells[condition.first(lane) + i * by].is_true();
                        let chosen = if is_true { accept } else { reject };
                        cells[out.first(lane) + i] = cells[chosen.first(lane) + i];
                    }
                }
            }
            Op::Convert { value, to } => {
                let from = layout.scalars[value.index()];
                map(cells, lanes, out, slot(value), |cell| math::convert(cell, from, to));
            }
            Op::Bitcast { value, to } => map(cells, lanes, out, slot(value), |cell| math::bitcast(cell, to)),
            Op::All(value) => {
                let value = slot(value);
                for lane in of(lanes) {
                    cells[out.first(lane)] = cells[value.cells(lane)].iter().all(|cell| cell.is_true()).into();
                }
            }
            Op::Any(value) => {
                let value = slot(value);
                for lane in of(lanes) {
                    cells[out.first(lane)] = cells[value.cells(lane)].iter().any(|cell| cell.is_true()).into();
                }
            }
            Op::Load { place } => {
                let place = places[slot(place).start as usize];
                for lane in of(lanes) {
                    let start = place[lane] as usize;
                    cells[out.cells(lane)].copy_from_slice(&self.memory[lane][start..start + out.size as usize]);
                }
            }
            _ => {
                for lane in of(lanes) {
                    scratch.clear();
                    self.read(frame, value, lane, scratch);
                    frame.cells[out.cells(lane)].copy_from_slice(scratch);
                }
            }
        }
    }

    /// Computes a value of one lane that is read from textures, or from its neighbours.
    fn read(&self, frame: &Frame<R>, value: Value, lane: usize, out: &mut Vec<Cell<R>>) {
        let cells = |value: Value| self.value(frame, value, lane);
        let int = |value: Value| cells(value)[0].bits() as i32;
        match self.module[frame.function][value] {
            Op::Derivative { axis, detail, value } => {
                // A coarse one is that of the quad's first pixel.
                let lane = if detail == Detail::Coarse { 0 } else { lane };
                self.derivative(frame, axis, value, lane, out);
            }
            Op::Sample { channel, coordinate, level, offset } => {
                self.sample(frame, (channel, coordinate, level, offset), lane, out);
            }
            Op::Gather { channel, component, coordinate, offset } => {
                self.gather(frame, (channel, component, coordinate, offset), lane, out);
            }
            Op::Fetch { channel, coordinate, level } => {
                let mut at = [0; 3];
                at.iter_mut().zip(cells(coordinate)).for_each(|(at, cell)| *at = cell.bits() as i32);
                let texel = self.world.fetch(channel, at, int(level));
                out.extend(texel.map(|number| Cell::Float(R::from_f64(number.into()))));
            }
            Op::TextureSize { channel, level } => {
                let size = self.world.size(channel, level.map_or(0, int));
                let count = self.layout(frame).slots[value.index()].size as usize;
                out.extend(size[..count].iter().map(|&n| Cell::Bits(n as u32)));
            }
            Op::TextureLevels { channel } => out.push(Cell::Bits(self.world.levels(channel))),
            Op::OpaqueZero => out.push(Cell::Bits(0)),
            ref other => unreachable!("{other:?} is computed elsewhere"),
        }
    }

    /// Returns the lanes whose difference is a derivative along x or y, in the row or column of a lane.
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

    fn derivative(&self, frame: &Frame<R>, axis: Axis, value: Value, lane: usize, out: &mut Vec<Cell<R>>) {
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

    fn sample(
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
                let of = if self.world.has_one_level_per_quad(channel) { 0 } else { lane };
                let changes = self.difference(frame, axis, coordinate, of);
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
