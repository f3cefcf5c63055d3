//! Filtering by hand, for channels whose texture the device cannot filter.
//!
//! Four reads of texel centres through the channel's own (nearest) sampler, which wraps them as it is told to, and a mix with the
//! weights of section 8.13 (equation 3.25 there) of the OpenGL ES 3.0 specification. Between two mip levels, the same in both.

use super::function::Builder;
use crate::glsl::{
    hir::{Scalar, TypeId},
    ir::{Axis, Binary, Level, Math, Op, Value},
};

impl Builder<'_, '_> {
    /// A filtered read of a 2D channel. `offset` counts texels.
    pub fn sample_by_hand(&mut self, channel: u8, at: Value, level: Level, offset: Option<Value>) -> Value {
        let lod = match level {
            Level::Exact(lod) => Some(lod),
            Level::Auto => {
                let (x, y) = (self.axis(Axis::X, at), self.axis(Axis::Y, at));
                Some(self.lod(channel, x, y))
            }
            Level::Bias(bias) => {
                let (x, y) = (self.axis(Axis::X, at), self.axis(Axis::Y, at));
                let lod = self.lod(channel, x, y);
                Some(self.op(Binary::Add, lod, bias))
            }
            Level::Gradient { x, y } => Some(self.lod(channel, x, y)),
        };
        let Some(lod) = lod else {
            let zero = self.float(0.0);
            return self.four_reads(channel, at, zero, offset);
        };
        let levels = self.add(Op::TextureLevels { channel });
        let levels = self.add(Op::Convert { value: levels, to: Scalar::Float });
        let one = self.float(1.0);
        let zero = self.float(0.0);
        let last = self.op(Binary::Subtract, levels, one);
        let lod = self.math3(Math::Clamp, lod, zero, last);
        let fine = self.math(Math::Floor, lod);
        let coarse = self.math(Math::Ceil, lod);
        let weight = self.op(Binary::Subtract, lod, fine);
        let fine = self.four_reads(channel, at, fine, offset);
        let coarse = self.four_reads(channel, at, coarse, offset);
        let weight = self.splat(weight, TypeId::VEC4);
        self.math3(Math::Mix, fine, coarse, weight)
    }

    fn axis(&mut self, axis: Axis, expr: Value) -> Value {
        self.add(Op::Derivative { axis, value: expr })
    }

    /// Section 8.14 (3.8.10 in older editions): the logarithm of the longer of the two footprints in texels.
    fn lod(&mut self, channel: u8, x: Value, y: Value) -> Value {
        let size = self.size_of_level(channel, None);
        let x = self.op(Binary::Multiply, x, size);
        let y = self.op(Binary::Multiply, y, size);
        let (x, y) = (self.math(Math::Length, x), self.math(Math::Length, y));
        let longer = self.math2(Math::Max, x, y);
        self.math(Math::Log2, longer)
    }

    fn size_of_level(&mut self, channel: u8, level: Option<Value>) -> Value {
        let level = level.map(|level| self.add(Op::Convert { value: level, to: Scalar::Int }));
        let size = self.texture_extent(channel, level);
        self.add(Op::Convert { value: size, to: Scalar::Float })
    }

    fn four_reads(&mut self, channel: u8, at: Value, level: Value, offset: Option<Value>) -> Value {
        let size = self.size_of_level(channel, Some(level));
        let mut texel = self.op(Binary::Multiply, at, size);
        if let Some(offset) = offset {
            let offset = self.add(Op::Convert { value: offset, to: Scalar::Float });
            texel = self.op(Binary::Add, texel, offset);
        }
        let half = self.float_of(TypeId::VEC2, 0.5);
        let corner = self.op(Binary::Subtract, texel, half);
        let whole = self.math(Math::Floor, corner);
        let weight = self.op(Binary::Subtract, corner, whole);
        let mut reads = Vec::with_capacity(4);
        for (x, y) in [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.5)] {
            let (x, y) = (self.float(x), self.float(y));
            let centre = self.compose(TypeId::VEC2, vec![x, y]);
            let texel = self.op(Binary::Add, whole, centre);
            let coordinate = self.op(Binary::Divide, texel, size);
            reads.push(self.image_sample(channel, coordinate, Level::Exact(level), None));
        }
        let parts = [0, 1].map(|index| {
            let part = self.add(Op::Part { base: weight, index });
            self.splat(part, TypeId::vector(Scalar::Float, 4))
        });
        let lower = self.math3(Math::Mix, reads[0], reads[1], parts[0]);
        let upper = self.math3(Math::Mix, reads[2], reads[3], parts[0]);
        self.math3(Math::Mix, lower, upper, parts[1])
    }
}
