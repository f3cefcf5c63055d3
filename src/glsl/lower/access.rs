//! Parts of variables and values: members, components, elements; places that are assigned to; clamped indices.

use super::{
    arguments::last_effect,
    context::const_id,
    function::{Builder, Slot},
    names::{Precondition, UnsetKind},
};
use crate::{
    UniformSource,
    hir::{BuiltinVar, ExprId, ExprKind, GlobalStorage, LocalId, Scalar, Swizzle, Type, TypeId, Uniform, VarFlags},
    ir::{Binary, Math, Op, Value},
};

/// A location in memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub pointer: Value,
    /// The type that the pointer points to.
    pub ty: TypeId,
    /// The selected components; `None` for all.
    pub swizzle: Option<Swizzle>,
}

impl Place {
    pub(super) fn of(pointer: Value, ty: TypeId) -> Self {
        Self { pointer, ty, swizzle: None }
    }
}

impl Builder<'_, '_> {
    /// Evaluates an l-value and its indices, once.
    pub(super) fn place(&mut self, expr: ExprId) -> Place {
        let (root, links) = self.chain(expr);
        let mut place = self.root(root, &links).expect("a place is in memory");
        for link in links.into_iter().rev() {
            place = self.part_of_place(place, link);
        }
        place
    }

    /// Returns the value of a variable or of a part of one, if it is in memory; otherwise the links from the outermost
    /// to the root.
    pub(super) fn read(&mut self, expr: ExprId) -> Result<Value, Vec<ExprId>> {
        let (root, links) = self.chain(expr);
        let Some(mut place) = self.root(root, &links) else { return Err(links) };
        for link in links.into_iter().rev() {
            place = self.part_of_place(place, link);
        }
        Ok(self.load_place(place))
    }

    /// Returns the place of an operand that is a variable or a part of one, if operands evaluated after it may change
    /// it.
    ///
    /// GLSL ES 3.00 does not define the order of operands. In ANGLE's code for SPIR-V (`OutputSPIRV.cpp`) an operand
    /// that is a chain of members, swizzles and indices stays one, with its indices evaluated, until its operator is
    /// applied; only then is it read. So `g * f()` multiplies by the value of `g` after `f`, and the same holds for
    /// arguments and constructors. Any other operand is evaluated immediately: `(g + 1.0) * f()` adds before.
    pub(super) fn read_late(&mut self, operand: ExprId, has_later_effects: bool) -> Option<Place> {
        if !has_later_effects {
            return None;
        }
        let (root, links) = self.chain(operand);
        if !matches!(self.cx.hir[root].kind, ExprKind::Local(_) | ExprKind::Global(_)) {
            return None;
        }
        let mut place = self.root(root, &links)?;
        for link in links.into_iter().rev() {
            place = self.part_of_place(place, link);
        }
        Some(place)
    }

    /// Returns the values of operands that are evaluated from left to right; see [`Builder::read_late`].
    pub(super) fn values(&mut self, operands: &[ExprId]) -> Vec<Value> {
        let last_effect = last_effect(self.cx.hir, operands);
        let mut late = Vec::new();
        let mut values = Vec::with_capacity(operands.len());
        for (i, &operand) in operands.iter().enumerate() {
            match self.read_late(self.written(operand), Some(i) < last_effect) {
                Some(place) => {
                    late.push((i, operand, place));
                    // A placeholder until the operand is read.
                    values.push(place.pointer);
                }
                None => values.push(self.value(operand)),
            }
        }
        for (i, operand, place) in late {
            let (written, read) = (self.written(operand), self.load_place(place));
            self.probe(written, read);
            values[i] = read;
            if written != operand {
                values[i] = self.convert(read, self.cx.hir[operand].ty);
                self.probe(operand, values[i]);
            }
        }
        values
    }

    /// Returns the operand as written if a constructor converts its components: `n` of `vec2(n, 1)`.
    fn written(&self, operand: ExprId) -> ExprId {
        let hir = self.cx.hir;
        match hir[operand].kind {
            // One that is written as `float(n)` starts before `n`.
            ExprKind::Convert(inner) if hir[inner].loc == hir[operand].loc => inner,
            _ => operand,
        }
    }

    /// Returns the base of members, swizzles and indices, and these from the outermost inwards.
    fn chain(&self, expr: ExprId) -> (ExprId, Vec<ExprId>) {
        let mut links = Vec::new();
        let mut root = expr;
        while let ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } | ExprKind::Index { base, .. } =
            self.cx.hir[root].kind
        {
            links.push(root);
            root = base;
        }
        (root, links)
    }

    /// Returns the memory that an expression names; `None` if it is a value.
    fn root(&mut self, root: ExprId, links: &[ExprId]) -> Option<Place> {
        let hir = self.cx.hir;
        let ty = hir[root].ty;
        let global = match hir[root].kind {
            ExprKind::Local(local) => match self.slot(local) {
                Slot::Memory(pointer) => return Some(Place::of(pointer, ty)),
                Slot::Table(id) => {
                    let table = self.cx.table(id);
                    return Some(Place::of(self.global(table), ty));
                }
                Slot::Unset if self.needs_memory(local) => {
                    let pointer = self.address_of(local);
                    return Some(Place::of(pointer, ty));
                }
                Slot::Unset | Slot::Value(_) | Slot::Channel(_) => return None,
            },
            ExprKind::Global(id) => {
                let global = hir[id];
                match global.storage {
                    GlobalStorage::Private | GlobalStorage::Out => {}
                    GlobalStorage::In if self.cx.source.kind.is_stage() => {
                        let variable = self.cx.global(id);
                        return Some(Place::of(self.global(variable), ty));
                    }
                    GlobalStorage::Uniform if self.cx.source.kind.is_plain() => {
                        let uniform = self.cx.plain_uniform(id);
                        return Some(Place::of(self.global(uniform), ty));
                    }
                    GlobalStorage::Const | GlobalStorage::Uniform | GlobalStorage::In => return None,
                }
                let varies =
                    global.flags.contains(VarFlags::WRITTEN) || (global.init.is_some() && global.value.is_none());
                if !varies && !self.indexes_aggregate(links) {
                    return None;
                }
                if let (false, Some(value)) = (varies, global.value) {
                    self.cx.table(const_id(value))
                } else {
                    self.cx.global(id)
                }
            }
            ExprKind::Uniform(uniform) => self.cx.uniform(uniform),
            ExprKind::BuiltinVar(BuiltinVar::FragCoord) => self.cx.frag_coord(),
            ExprKind::BuiltinVar(BuiltinVar::FragDepth) => self.cx.frag_depth(),
            ExprKind::BuiltinVar(variable)
                if variable.is_of_vertices()
                    || (variable == BuiltinVar::FrontFacing && self.cx.source.kind.is_stage()) =>
            {
                self.cx.stage_variable(variable)
            }
            ExprKind::Const(id) if self.indexes_aggregate(links) => self.cx.table(const_id(id)),
            _ => return None,
        };
        Some(Place::of(self.global(global), ty))
    }

    /// Returns the value of a custom uniform.
    fn custom_uniform(&mut self, index: u16, ty: TypeId) -> Value {
        match self.cx.source.custom_uniforms[usize::from(index)].source {
            UniformSource::Slot(slot) => self.uniform_in_slot(slot, ty),
            UniformSource::Resolution if ty == TypeId::VEC3 => {
                let resolution = self.cx.uniform(Uniform::Resolution);
                let pointer = self.global(resolution);
                self.load(pointer)
            }
            UniformSource::Resolution => self.resolution(),
            UniformSource::ChannelSize(channel) => self.channel_size(channel),
            UniformSource::UnitPosition => {
                let (at, size) = (self.pixel_position(), self.resolution());
                self.op(Binary::Divide, at, size)
            }
            UniformSource::CentredPosition => {
                let (at, size) = (self.pixel_position(), self.resolution());
                let half = self.float_of(TypeId::VEC2, 0.5);
                let centre = self.op(Binary::Multiply, size, half);
                let from_centre = self.op(Binary::Subtract, at, centre);
                let height = self.swizzle(size, TypeId::VEC2, Swizzle::new(&[1, 1]));
                self.op(Binary::Divide, from_centre, height)
            }
            UniformSource::ClipPosition => {
                let (at, size) = (self.pixel_position(), self.resolution());
                let unit = self.op(Binary::Divide, at, size);
                let (two, one) = (self.float_of(TypeId::VEC2, 2.0), self.float_of(TypeId::VEC2, 1.0));
                let twice = self.op(Binary::Multiply, unit, two);
                let clip = self.op(Binary::Subtract, twice, one);
                let (depth, w) = (self.float(0.0), self.float(1.0));
                self.compose(TypeId::VEC4, vec![clip, depth, w])
            }
        }
    }

    /// Returns the size in texels of the texture of a channel.
    fn channel_size(&mut self, channel: u8) -> Value {
        let size = self.add_typed(Op::TextureSize { channel, level: None }, TypeId::vector(Scalar::Int, 2));
        self.add(Op::Convert { value: size, to: Scalar::Float })
    }

    /// Returns the size in pixels of the target that the pass draws.
    fn resolution(&mut self) -> Value {
        let resolution = self.cx.uniform(Uniform::Resolution);
        let pointer = self.global(resolution);
        let resolution = self.load(pointer);
        self.swizzle(resolution, TypeId::VEC3, Swizzle::new(&[0, 1]))
    }

    /// Returns the position of the pixel from the bottom left corner of the target, in pixels.
    fn pixel_position(&mut self) -> Value {
        let position = self.cx.frag_coord();
        let pointer = self.global(position);
        let position = self.load(pointer);
        self.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]))
    }

    /// Returns the words of a slot, converted to a type.
    fn uniform_in_slot(&mut self, slot: u16, ty: TypeId) -> Value {
        let block = self.cx.custom_uniform(slot);
        let pointer = self.global(block);
        let words = self.load(pointer);
        let size = self.cx.hir.types.components(ty).expect("a scalar or a vector") as usize;
        let words = self.swizzle(words, TypeId::vector(Scalar::Uint, 4), Swizzle::new(&[0, 1, 2, 3][..size]));
        match self.cx.hir.types.scalar(ty) {
            Some(Scalar::Bool) => {
                let zero = self.literal(Scalar::Uint, 0);
                self.op(Binary::NotEqual, words, zero)
            }
            Some(Scalar::Int) => self.bitcast(words, Scalar::Int),
            Some(Scalar::Uint) => words,
            _ => self.bitcast(words, Scalar::Float),
        }
    }

    /// Returns the value of a root that is not in memory.
    pub(super) fn root_value(&mut self, root: ExprId) -> Value {
        let hir = self.cx.hir;
        let ty = hir[root].ty;
        match hir[root].kind {
            ExprKind::Local(local) => match self.slot(local) {
                Slot::Value(value) => value,
                // Its declaration was skipped, so any value is allowed.
                _ => self.zero(ty),
            },
            ExprKind::Global(id) => match hir[id].value {
                Some(value) if hir[id].storage == GlobalStorage::Private => self.folded(value),
                None if hir[id].storage == GlobalStorage::Private => {
                    self.undefined(ty, UnsetKind::Variable, hir[id].name)
                }
                _ => self.zero(ty),
            },
            ExprKind::CustomUniform(index) => self.custom_uniform(index, ty),
            ExprKind::BuiltinVar(BuiltinVar::FrontFacing) => self.literal(Scalar::Bool, 1),
            _ => self.zero(ty),
        }
    }

    /// Returns whether some non-literal index accesses an array or matrix.
    fn indexes_aggregate(&self, links: &[ExprId]) -> bool {
        let hir = self.cx.hir;
        links.iter().any(|&link| match hir[link].kind {
            ExprKind::Index { base, index } => {
                !matches!(hir[index].kind, ExprKind::Literal(_)) && !self.is_vector_or_scalar(hir[base].ty)
            }
            _ => false,
        })
    }

    fn part_of_place(&mut self, place: Place, link: ExprId) -> Place {
        let hir = self.cx.hir;
        let ty = hir[link].ty;
        let base = place.pointer;
        let pointer = match hir[link].kind {
            ExprKind::Member { index, .. } => self.add(Op::Part { base, index }),
            ExprKind::Swizzle { swizzle, .. } => {
                let swizzle = match place.swizzle {
                    None => swizzle,
                    Some(outer) => compose_swizzles(outer, swizzle),
                };
                if swizzle.len() > 1 {
                    return Place { swizzle: Some(swizzle), ..place };
                }
                self.add(Op::Part { base, index: swizzle.get(0) as u32 })
            }
            ExprKind::Index { index, .. } => {
                let pointer = match (hir[index].kind, place.swizzle) {
                    (ExprKind::Literal(i), None) => self.add(Op::Part { base, index: i }),
                    (ExprKind::Literal(i), Some(swizzle)) => {
                        self.add(Op::Part { base, index: swizzle.get(i as usize) as u32 })
                    }
                    (_, None) => {
                        let index = self.index(index, self.extent(place.ty));
                        self.add(Op::Element { base, index })
                    }
                    (_, Some(swizzle)) => {
                        let index = self.index(index, swizzle.len() as u32);
                        let components = swizzle.iter().map(|c| self.literal(Scalar::Uint, c as u32)).collect();
                        let table = self.compose(TypeId::vector(Scalar::Uint, swizzle.len() as u8), components);
                        let index = self.add(Op::Element { base: table, index });
                        self.add(Op::Element { base, index })
                    }
                };
                return Place::of(pointer, ty);
            }
            other => unreachable!("{other:?} is no part"),
        };
        Place::of(pointer, ty)
    }

    pub(super) fn load_place(&mut self, place: Place) -> Value {
        let value = self.load(place.pointer);
        match place.swizzle {
            Some(swizzle) => self.swizzle(value, place.ty, swizzle),
            None => value,
        }
    }

    pub(super) fn store_place(&mut self, place: Place, value: Value) {
        let Some(swizzle) = place.swizzle else { return self.store(place.pointer, value) };
        for (i, component) in swizzle.iter().enumerate() {
            let part = self.add(Op::Part { base: value, index: i as u32 });
            let pointer = self.add(Op::Part { base: place.pointer, index: component as u32 });
            self.store(pointer, part);
        }
    }

    /// Returns a part of a value; `link` is the member, swizzle or index whose base has this value.
    pub(super) fn part_of_value(&mut self, base: Value, link: ExprId) -> Value {
        let hir = self.cx.hir;
        match hir[link].kind {
            ExprKind::Member { index, .. } => self.add(Op::Part { base, index }),
            ExprKind::Swizzle { base: of, swizzle } => self.swizzle(base, hir[of].ty, swizzle),
            ExprKind::Index { base: of, index } => {
                if let ExprKind::Literal(index) = hir[index].kind {
                    return self.add(Op::Part { base, index });
                }
                let of = hir[of].ty;
                let index = self.index(index, self.extent(of));
                if self.is_vector_or_scalar(of) {
                    return self.add(Op::Element { base, index });
                }
                // Only memory can be indexed at run time.
                let memory = self.temporary(of);
                self.store(memory, base);
                let pointer = self.add(Op::Element { base: memory, index });
                self.load(pointer)
            }
            other => unreachable!("{other:?} is no part"),
        }
    }

    /// Selects components of a vector of type `ty`.
    pub(super) fn swizzle(&mut self, vector: Value, ty: TypeId, swizzle: Swizzle) -> Value {
        if swizzle.len() == 1 {
            return self.add(Op::Part { base: vector, index: swizzle.get(0) as u32 });
        }
        if swizzle.len() as u32 == self.extent(ty) && swizzle.iter().enumerate().all(|(i, c)| i == c) {
            return vector;
        }
        self.add(Op::Swizzle { vector, swizzle })
    }

    /// Returns the number of elements of an array, columns of a matrix, or components of a vector.
    pub(super) fn extent(&self, ty: TypeId) -> u32 {
        match self.cx.hir.types.get(ty) {
            Type::Array { len, .. } => len,
            Type::Matrix { columns, .. } => columns.into(),
            Type::Vector { size, .. } => size.into(),
            _ => 1,
        }
    }

    /// Returns an index, clamped to `0..len`: WebGL forbids out-of-bounds accesses, and its implementations clamp.
    fn index(&mut self, index: ExprId, len: u32) -> Value {
        let value = self.value(index);
        let clamped = if self.cx.hir[index].ty == TypeId::UINT {
            let last = self.literal(Scalar::Uint, len - 1);
            self.math2(Math::Min, value, last)
        } else {
            let (zero, last) = (self.literal(Scalar::Int, 0), self.literal(Scalar::Int, len - 1));
            let positive = self.math2(Math::Max, value, zero);
            self.math2(Math::Min, positive, last)
        };
        self.record_precondition(clamped, || Precondition::Index(value, len));
        clamped
    }

    /// Adds the components of a vector, or a scalar itself.
    pub(super) fn components(&mut self, value: Value, ty: TypeId, out: &mut Vec<Value>) {
        match self.cx.hir.types.get(ty) {
            Type::Vector { size, .. } => {
                for index in 0..u32::from(size) {
                    let part = self.add(Op::Part { base: value, index });
                    out.push(part);
                }
            }
            Type::Matrix { columns, rows } => {
                let column_ty = TypeId::vector(Scalar::Float, rows);
                for index in 0..u32::from(columns) {
                    let column = self.add(Op::Part { base: value, index });
                    self.components(column, column_ty, out);
                }
            }
            _ => out.push(value),
        }
    }

    /// Reinterprets the bits of a scalar or vector.
    pub(super) fn bitcast(&mut self, value: Value, to: Scalar) -> Value {
        self.add(Op::Bitcast { value, to })
    }

    /// Returns the variable of this function that an expression names as a whole, if it is in memory.
    pub(super) fn whole_local(&self, expr: ExprId) -> Option<(LocalId, Value)> {
        match self.cx.hir[expr].kind {
            ExprKind::Local(local) => match self.slot(local) {
                Slot::Memory(pointer) => Some((local, pointer)),
                _ => None,
            },
            _ => None,
        }
    }
}

/// Returns the swizzle that applies `inner` to the result of `outer`.
fn compose_swizzles(outer: Swizzle, inner: Swizzle) -> Swizzle {
    let components: Vec<u8> = inner.iter().map(|c| outer.get(c) as u8).collect();
    Swizzle::new(&components)
}
