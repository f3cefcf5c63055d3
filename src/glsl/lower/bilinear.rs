//! Filtering by hand, for channels whose texture the device cannot filter.
//!
//! Four reads of texel centres through the channel's own (nearest) sampler, which wraps them as it is told to, and a mix with the
//! weights of section 8.13 (equation 3.25 there) of the OpenGL ES 3.0 specification. Between two mip levels, the same in both.

use naga::{BinaryOperator as Op, DerivativeAxis, DerivativeControl, Expression, ImageQuery, MathFunction as Math};
use naga::{SampleLevel, ScalarKind};

use super::function::{Builder, Value};
use crate::glsl::hir::{Scalar, TypeId};

impl Builder<'_, '_> {
    /// A filtered read of a 2D channel. `offset` counts texels.
    pub fn sample_by_hand(&mut self, channel: u8, at: Value, level: SampleLevel, offset: Option<Value>) -> Value {
        let lod = match level {
            SampleLevel::Zero => None,
            SampleLevel::Exact(lod) => Some(lod),
            SampleLevel::Auto => {
                let (x, y) = (self.axis(DerivativeAxis::X, at), self.axis(DerivativeAxis::Y, at));
                Some(self.lod(channel, x, y))
            }
            SampleLevel::Bias(bias) => {
                let (x, y) = (self.axis(DerivativeAxis::X, at), self.axis(DerivativeAxis::Y, at));
                let lod = self.lod(channel, x, y);
                Some(self.op(Op::Add, lod, bias))
            }
            SampleLevel::Gradient { x, y } => Some(self.lod(channel, x, y)),
        };
        let Some(lod) = lod else {
            let zero = self.float(0.0);
            return self.four_reads(channel, at, zero, offset);
        };
        let image = self.cx.texture(channel);
        let image = self.global(image);
        let levels = self.add(Expression::ImageQuery { image, query: ImageQuery::NumLevels });
        let levels = self.add(Expression::As { expr: levels, kind: ScalarKind::Float, convert: Some(4) });
        let one = self.float(1.0);
        let zero = self.float(0.0);
        let last = self.op(Op::Subtract, levels, one);
        let lod = self.math3(Math::Clamp, lod, zero, last);
        let fine = self.math(Math::Floor, lod);
        let coarse = self.math(Math::Ceil, lod);
        let weight = self.op(Op::Subtract, lod, fine);
        let fine = self.four_reads(channel, at, fine, offset);
        let coarse = self.four_reads(channel, at, coarse, offset);
        let weight = self.splat(weight, TypeId::VEC4);
        self.math3(Math::Mix, fine, coarse, weight)
    }

    fn axis(&mut self, axis: DerivativeAxis, expr: Value) -> Value {
        self.add(Expression::Derivative { axis, ctrl: DerivativeControl::None, expr })
    }

    /// Section 8.14 (3.8.10 in older editions): the logarithm of the longer of the two footprints in texels.
    fn lod(&mut self, channel: u8, x: Value, y: Value) -> Value {
        let size = self.size_of_level(channel, None);
        let x = self.op(Op::Multiply, x, size);
        let y = self.op(Op::Multiply, y, size);
        let (x, y) = (self.math(Math::Length, x), self.math(Math::Length, y));
        let longer = self.math2(Math::Max, x, y);
        self.math(Math::Log2, longer)
    }

    fn size_of_level(&mut self, channel: u8, level: Option<Value>) -> Value {
        let image = self.cx.texture(channel);
        let image = self.global(image);
        let level =
            level.map(|level| self.add(Expression::As { expr: level, kind: ScalarKind::Sint, convert: Some(4) }));
        let size = self.add(Expression::ImageQuery { image, query: ImageQuery::Size { level } });
        self.add(Expression::As { expr: size, kind: ScalarKind::Float, convert: Some(4) })
    }

    fn four_reads(&mut self, channel: u8, at: Value, level: Value, offset: Option<Value>) -> Value {
        let size = self.size_of_level(channel, Some(level));
        let mut texel = self.op(Op::Multiply, at, size);
        if let Some(offset) = offset {
            let offset = self.add(Expression::As { expr: offset, kind: ScalarKind::Float, convert: Some(4) });
            texel = self.op(Op::Add, texel, offset);
        }
        let half = self.float_of(TypeId::VEC2, 0.5);
        let corner = self.op(Op::Subtract, texel, half);
        let whole = self.math(Math::Floor, corner);
        let weight = self.op(Op::Subtract, corner, whole);
        let mut reads = Vec::with_capacity(4);
        for (x, y) in [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.5)] {
            let (x, y) = (self.float(x), self.float(y));
            let centre = self.compose(TypeId::VEC2, vec![x, y]);
            let texel = self.op(Op::Add, whole, centre);
            let coordinate = self.op(Op::Divide, texel, size);
            reads.push(self.image_sample(channel, coordinate, SampleLevel::Exact(level), None));
        }
        let parts = [0, 1].map(|index| {
            let part = self.add(Expression::AccessIndex { base: weight, index });
            self.splat(part, TypeId::vector(Scalar::Float, 4))
        });
        let lower = self.math3(Math::Mix, reads[0], reads[1], parts[0]);
        let upper = self.math3(Math::Mix, reads[2], reads[3], parts[0]);
        self.math3(Math::Mix, lower, upper, parts[1])
    }
}
