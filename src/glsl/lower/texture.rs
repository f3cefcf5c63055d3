//! Texture functions (section 8.8) on channels.

use super::function::Builder;
use crate::{
    builtins::{Form, Lod, Operation},
    hir::{ExprId, ExprKind, SamplerDim, Scalar, Swizzle, TypeId},
    ir::{Axis, Binary, Detail, Level, Math, Op, Value},
};

impl Builder<'_, '_> {
    /// Calls a function whose operation reads a texture.
    pub(super) fn texture(&mut self, operation: Operation, ty: TypeId, args: &[ExprId]) -> Value {
        let channel = self.channel(args[0]);
        match operation {
            Operation::Sample(form) => self.sample(channel, form, args),
            Operation::Fetch { .. } => self.texel_fetch(channel, args),
            Operation::Gather { offset } => self.gather(channel, offset, args),
            Operation::QueryLevels => self.query_levels(channel, Scalar::Int),
            Operation::QueryLod => self.query_lod(channel, args[1]),
            _ => self.texture_size(channel, ty, args[1]),
        }
    }

    fn kind(&self, channel: u8) -> SamplerDim {
        self.cx.out.textures[usize::from(channel)].dim
    }

    /// Returns the number of components of a coordinate of the channel, including the reference value of a comparison.
    fn dimensions(&self, channel: u8) -> u8 {
        let dimensions = match self.kind(channel) {
            SamplerDim::D1 | SamplerDim::D2 => 2,
            SamplerDim::D3 | SamplerDim::Cube | SamplerDim::D2Array => 3,
        };
        dimensions + u8::from(self.cx.out.textures[usize::from(channel)].shadow)
    }

    fn texture_size(&mut self, channel: u8, ty: TypeId, lod: ExprId) -> Value {
        let level = match self.literal_bits(lod) {
            Some(0) => None,
            _ => {
                self.cx.reflection.channel(channel).mips = true;
                Some(self.value(lod))
            }
        };
        debug_assert_eq!(self.cx.hir.types.scalar(ty), Some(Scalar::Int));
        let size = match self.kind(channel) {
            SamplerDim::D1 | SamplerDim::D2 | SamplerDim::Cube => 2,
            SamplerDim::D3 | SamplerDim::D2Array => 3,
        };
        let all = self.add_typed(Op::TextureSize { channel, level }, TypeId::vector(Scalar::Int, size));
        if ty == TypeId::INT { self.add(Op::Part { base: all, index: 0 }) } else { all }
    }

    /// Returns a coordinate as an operation on the texture takes it: for a row of texels with the second component of
    /// its centre.
    fn coordinate(&mut self, coordinate: ExprId) -> Value {
        let value = self.value(coordinate);
        match self.cx.hir[coordinate].ty {
            TypeId::FLOAT => {
                let middle = self.float(0.5);
                self.compose(TypeId::VEC2, vec![value, middle])
            }
            TypeId::INT => {
                let row = self.literal(Scalar::Int, 0);
                self.compose(TypeId::vector(Scalar::Int, 2), vec![value, row])
            }
            _ => value,
        }
    }

    /// Lowers `texelFetch(sampler, coordinate, level[, offset])`. Outside the texture it returns zeros: the driver
    /// ensures that.
    fn texel_fetch(&mut self, channel: u8, args: &[ExprId]) -> Value {
        let mut coordinate = self.coordinate(args[1]);
        let level = self.value(args[2]);
        if self.literal_bits(args[2]) != Some(0) {
            self.cx.reflection.channel(channel).mips = true;
        }
        if let Some(&offset) = args.get(3) {
            let mut offset = self.value(offset);
            if self.kind(channel) == SamplerDim::D2Array {
                let layer = self.literal(Scalar::Int, 0);
                offset = self.compose(TypeId::vector(Scalar::Int, 3), vec![offset, layer]);
            }
            coordinate = self.op(Binary::Add, coordinate, offset);
        }
        self.add(Op::Fetch { channel, coordinate, level })
    }

    fn sample(&mut self, channel: u8, form: Form, args: &[ExprId]) -> Value {
        let hir = self.cx.hir;
        let mut rest = args[2..].iter().copied();
        let mut next = || rest.next();
        let mut coordinate = self.coordinate(args[1]);
        let mut level = match form.lod {
            Lod::Implicit => Level::Auto,
            Lod::Exact => {
                let lod = next().expect("a level");
                let is_base = self.literal_bits(lod).is_some_and(|bits| f32::from_bits(bits) == 0.0);
                self.cx.reflection.channel(channel).mips |= !is_base;
                Level::Exact(self.value(lod))
            }
            Lod::Gradient => {
                let (x, y) = (next().expect("a gradient"), next().expect("a gradient"));
                Level::Gradient { x: self.value(x), y: self.value(y) }
            }
        };
        let offset = form.offset.and_then(|_| next());
        if let (Lod::Implicit, Some(bias)) = (form.lod, next()) {
            level = Level::Bias(self.value(bias));
        }
        if self.cx.source.kind.is_vertex() && matches!(level, Level::Auto | Level::Bias(_)) {
            // Section 8.8: without derivatives the base level is read.
            level = Level::Exact(self.float(0.0));
        }
        match level {
            Level::Auto | Level::Bias(_) | Level::Gradient { .. } => {
                self.cx.reflection.channel(channel).mips = true;
            }
            Level::Exact(_) => {}
        }
        if form.is_projected {
            coordinate = self.divide_by_last(coordinate, hir[args[1]].ty, self.dimensions(channel));
        }
        let offset = offset.map(|offset| self.constant_offset(offset));
        self.add(Op::Sample { channel, coordinate, level, offset })
    }

    /// Lowers `textureGather(sampler, coordinate[, offset][, component])`, or with a reference value as the last argument.
    fn gather(&mut self, channel: u8, offset: Option<usize>, args: &[ExprId]) -> Value {
        let mut coordinate = self.value(args[1]);
        let mut component = 0;
        if let Some(&last) = args.get(2 + usize::from(offset.is_some())) {
            if self.cx.out.textures[usize::from(channel)].shadow {
                let ty = TypeId::vector(Scalar::Float, self.dimensions(channel));
                let reference = self.value(last);
                coordinate = self.compose(ty, vec![coordinate, reference]);
            } else {
                component = self.literal_bits(last).map_or(0, |bits| bits as u8 & 3);
            }
        }
        let offset = offset.map(|at| self.constant_offset(args[at]));
        self.add(Op::Gather { channel, component, coordinate, offset })
    }

    /// Returns the number of mip levels.
    fn query_levels(&mut self, channel: u8, to: Scalar) -> Value {
        self.cx.reflection.channel(channel).mips = true;
        let value = self.add(Op::TextureLevels { channel });
        self.add(Op::Convert { value, to })
    }

    /// Lowers `textureQueryLod(sampler, coordinate)`, which WGSL does not have: the logarithm of the longer footprint of
    /// the pixel in texels (section 8.14 of the OpenGL 4.6 specification).
    fn query_lod(&mut self, channel: u8, coordinate: ExprId) -> Value {
        let kind = self.kind(channel);
        let (mut at, mut ty) = (self.coordinate(coordinate), self.cx.hir[coordinate].ty);
        if ty == TypeId::FLOAT {
            ty = TypeId::VEC2;
        }
        let count = if matches!(kind, SamplerDim::D3 | SamplerDim::D2Array) { 3 } else { 2 };
        let level = None;
        let size = self.add_typed(Op::TextureSize { channel, level }, TypeId::vector(Scalar::Int, count));
        let mut size = self.add(Op::Convert { value: size, to: Scalar::Float });
        match kind {
            SamplerDim::D2Array => size = self.swizzle(size, TypeId::VEC3, Swizzle::new(&[0, 1])),
            SamplerDim::Cube => {
                // The coordinates on all faces at once: those of one face are this divided by its axis, -1 to 1.
                let parts = [0, 1, 2].map(|index| {
                    let part = self.add(Op::Part { base: at, index });
                    self.math(Math::Abs, part)
                });
                let longest = self.math2(Math::Max, parts[0], parts[1]);
                let longest = self.math2(Math::Max, longest, parts[2]);
                let longest = self.splat(longest, ty);
                at = self.op(Binary::Divide, at, longest);
                let half = self.float(0.5);
                let width = self.add(Op::Part { base: size, index: 0 });
                let width = self.op(Binary::Multiply, width, half);
                size = self.splat(width, ty);
            }
            _ => {}
        }
        let texels = self.op(Binary::Multiply, at, size);
        let [x, y] = [Axis::X, Axis::Y].map(|axis| {
            let side = self.derivative(axis, Detail::Any, texels);
            self.length(ty, side)
        });
        let longer = self.math2(Math::Max, x, y);
        let lod = self.math(Math::Log2, longer);
        let levels = self.query_levels(channel, Scalar::Float);
        let (zero, one) = (self.float(0.0), self.float(1.0));
        let last = self.op(Binary::Subtract, levels, one);
        let read = self.math3(Math::Clamp, lod, zero, last);
        self.compose(TypeId::VEC2, vec![read, lod])
    }

    /// Returns a constant offset, in a form that naga's validator accepts as constant.
    fn constant_offset(&mut self, offset: ExprId) -> Value {
        debug_assert!(matches!(self.cx.hir[offset].kind, ExprKind::Const(_) | ExprKind::Literal(_)));
        self.value(offset)
    }

    fn divide_by_last(&mut self, coordinate: Value, ty: TypeId, dimensions: u8) -> Value {
        let last = self.extent(ty) - 1;
        let divisor = self.add(Op::Part { base: coordinate, index: last });
        let components: Vec<u8> = (0..dimensions).collect();
        let numerator = self.swizzle(coordinate, ty, Swizzle::new(&components));
        // Times the reciprocal, as in drivers that implement projective reads themselves.
        let one = self.float(1.0);
        let scale = self.op(Binary::Divide, one, divisor);
        self.op(Binary::Multiply, numerator, scale)
    }
}
