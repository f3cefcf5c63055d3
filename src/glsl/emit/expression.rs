//! The operations of a function that are expressions of naga's.

use naga::{Expression, ImageQuery, SampleLevel, ScalarKind};

use super::{
    function::Builder,
    operators::{binary, math, pattern, unary},
    types,
};
use crate::{
    ir::{self, Level, Op, Value},
    types::{Type, TypeId},
};

impl Builder<'_, '_> {
    /// Returns the expression that computes a value.
    pub(super) fn expression(&mut self, value: Value, op: &Op) -> Expression {
        if let Op::Compose { ty, ref parts } = *op {
            return self.compose_op(ty, parts);
        }
        let mut of = |value: Value| self.value(value);
        match *op {
            Op::Part { base, index } => Expression::AccessIndex { base: of(base), index },
            Op::Element { base, index } => Expression::Access { base: of(base), index: of(index) },
            Op::Swizzle { vector, swizzle } => Expression::Swizzle {
                size: types::vector_size(swizzle.len()),
                vector: of(vector),
                pattern: pattern(swizzle),
            },
            Op::Splat { size, value } => Expression::Splat { size: types::vector_size(size.into()), value: of(value) },
            Op::Unary { op, operand } => Expression::Unary { op: unary(op), expr: of(operand) },
            Op::Binary { op, left, right } => Expression::Binary { op: binary(op), left: of(left), right: of(right) },
            Op::Math { fun, arg, arg1, arg2, arg3 } => {
                let (arg, arg1, arg2, arg3) = (of(arg), arg1.map(&mut of), arg2.map(&mut of), arg3.map(&mut of));
                Expression::Math { fun: math(fun), arg, arg1, arg2, arg3 }
            }
            Op::Select { condition, accept, reject } => {
                Expression::Select { condition: of(condition), accept: of(accept), reject: of(reject) }
            }
            Op::Convert { value, to } => {
                let width = types::naga_scalar(to).width;
                Expression::As { expr: of(value), kind: types::naga_scalar(to).kind, convert: Some(width) }
            }
            Op::Bitcast { value, to } => {
                Expression::As { expr: of(value), kind: types::naga_scalar(to).kind, convert: None }
            }
            Op::All(argument) => Expression::Relational { fun: naga::RelationalFunction::All, argument: of(argument) },
            Op::Any(argument) => Expression::Relational { fun: naga::RelationalFunction::Any, argument: of(argument) },
            Op::Derivative { axis, value } => Expression::Derivative {
                axis: match axis {
                    ir::Axis::X => naga::DerivativeAxis::X,
                    ir::Axis::Y => naga::DerivativeAxis::Y,
                    ir::Axis::Width => naga::DerivativeAxis::Width,
                },
                ctrl: naga::DerivativeControl::None,
                expr: of(value),
            },
            Op::Sample { channel, coordinate, level, offset } => {
                let (coordinate, offset) = (of(coordinate), offset.map(&mut of));
                let level = match level {
                    Level::Auto => SampleLevel::Auto,
                    Level::Exact(level) => SampleLevel::Exact(of(level)),
                    Level::Bias(bias) => SampleLevel::Bias(of(bias)),
                    Level::Gradient { x, y } => SampleLevel::Gradient { x: of(x), y: of(y) },
                };
                let (image, sampler) = (self.cx.texture(channel), self.cx.sampler(channel));
                let (image, sampler) = (self.variable(image), self.variable(sampler));
                Expression::ImageSample {
                    image,
                    sampler,
                    gather: None,
                    coordinate,
                    array_index: None,
                    offset,
                    level,
                    depth_ref: None,
                    clamp_to_edge: false,
                }
            }
            Op::Fetch { channel, coordinate, level } => {
                let (coordinate, level) = (of(coordinate), of(level));
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                Expression::ImageLoad { image, coordinate, array_index: None, sample: None, level: Some(level) }
            }
            Op::TextureSize { channel, level } => {
                let level = level.map(&mut of);
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                let size = self.add(Expression::ImageQuery { image, query: ImageQuery::Size { level } });
                Expression::As { expr: size, kind: ScalarKind::Sint, convert: None }
            }
            Op::TextureLevels { channel } => {
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                Expression::ImageQuery { image, query: ImageQuery::NumLevels }
            }
            ref other => unreachable!("{value:?} = {other:?} is no expression"),
        }
    }

    fn compose_op(&mut self, ty: TypeId, parts: &[Value]) -> Expression {
        let mut components = Vec::with_capacity(parts.len());
        let is_vector = matches!(self.cx.ir.types.get(ty), Type::Vector { .. });
        for &part in parts {
            match self.ir[part] {
                // naga's SPIR-V writer takes a constant vector within a constant vector for one component.
                Op::Const(id) if is_vector => {
                    let ir = self.cx.ir;
                    let scalar = ir.scalar(ir[id].ty);
                    components.extend(ir[id].words.iter().map(|&bits| self.literal(scalar, bits)));
                }
                Op::Zero(zero) if is_vector => {
                    let scalar = self.cx.ir.scalar(zero);
                    let size = self.cx.ir.extent(zero).max(1);
                    components.extend((0..size).map(|_| self.literal(scalar, 0)));
                }
                _ => components.push(self.value(part)),
            }
        }
        Expression::Compose { ty: self.cx.ty(ty), components }
    }
}
