//! The operations of a function that are naga expressions.

use naga::{Expression, Handle, ImageQuery, SampleLevel, ScalarKind};

use super::{
    function::Builder,
    operators::{XYZW, binary, math, pattern, unary},
    types,
};
use crate::{
    ir::{self, Level, Op, Value},
    types::{SamplerDim, Scalar, Swizzle, Type, TypeId},
};

/// The coordinate of a read, in naga's form.
struct Coordinate {
    coordinate: Handle<Expression>,
    array_index: Option<Handle<Expression>>,
    depth_ref: Option<Handle<Expression>>,
}

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
            Op::Derivative { axis, detail, value } => Expression::Derivative {
                axis: match axis {
                    ir::Axis::X => naga::DerivativeAxis::X,
                    ir::Axis::Y => naga::DerivativeAxis::Y,
                    ir::Axis::Width => naga::DerivativeAxis::Width,
                },
                ctrl: match detail {
                    ir::Detail::Any => naga::DerivativeControl::None,
                    ir::Detail::Coarse => naga::DerivativeControl::Coarse,
                    ir::Detail::Fine => naga::DerivativeControl::Fine,
                },
                expr: of(value),
            },
            Op::Sample { channel, coordinate, level, offset } => {
                let (coordinate, offset) = (of(coordinate), offset.map(&mut of));
                let (dim, shadow) = self.texture_shape(channel);
                let at = self.coordinate(coordinate, dim, shadow);
                let mut of = |value: Value| self.value(value);
                let level = match level {
                    // WebGPU compares in the base level, or in the one selected by derivatives.
                    Level::Exact(_) if shadow => SampleLevel::Zero,
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
                    coordinate: at.coordinate,
                    array_index: at.array_index,
                    offset,
                    level,
                    depth_ref: at.depth_ref,
                    clamp_to_edge: false,
                }
            }
            Op::Gather { channel, component, coordinate, offset } => {
                let (coordinate, offset) = (of(coordinate), offset.map(&mut of));
                let (dim, shadow) = self.texture_shape(channel);
                let at = self.coordinate(coordinate, dim, shadow);
                let (image, sampler) = (self.cx.texture(channel), self.cx.sampler(channel));
                let (image, sampler) = (self.variable(image), self.variable(sampler));
                Expression::ImageSample {
                    image,
                    sampler,
                    gather: Some(XYZW[usize::from(component)]),
                    coordinate: at.coordinate,
                    array_index: at.array_index,
                    offset,
                    level: SampleLevel::Zero,
                    depth_ref: at.depth_ref,
                    clamp_to_edge: false,
                }
            }
            Op::Fetch { channel, coordinate, level } => {
                let (coordinate, level) = (of(coordinate), of(level));
                let (dim, _) = self.texture_shape(channel);
                let at = self.texel(coordinate, dim);
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                let (coordinate, array_index) = (at.coordinate, at.array_index);
                Expression::ImageLoad { image, coordinate, array_index, sample: None, level: Some(level) }
            }
            Op::TextureSize { channel, level } => {
                let of_level = level.map(&mut of);
                let is_base = level.is_none_or(|level| matches!(self.ir[level], Op::Literal(_, 0) | Op::Zero(_)));
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                let base = of_level.map(|_| self.literal(Scalar::Int, 0));
                let mut size = self.add(Expression::ImageQuery { image, query: ImageQuery::Size { level: base } });
                let dim = self.texture_shape(channel).0;
                if let Some(level) = of_level.filter(|_| !is_base) {
                    size = self.size_of_level(size, level, if dim == SamplerDim::D3 { 3 } else { 2 });
                }
                if dim == SamplerDim::D2Array {
                    let layers = self.add(Expression::ImageQuery { image, query: ImageQuery::NumLayers });
                    size = self.compose(TypeId::vector(Scalar::Uint, 3), vec![size, layers]);
                }
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

    /// Returns the size of a level computed from that of level 0: max(1, size >> level), OpenGL ES 3.0, 3.8.10.4. This
    /// also works for levels that a texture does not have: their size is undefined (GLSL ES 3.00, 8.8), and OpenGL
    /// drivers return this one, while Vulkan drivers return zeros.
    fn size_of_level(&mut self, size: Handle<Expression>, level: Handle<Expression>, count: u8) -> Handle<Expression> {
        let (max_level, one) = (self.literal(Scalar::Uint, 31), self.literal(Scalar::Uint, 1));
        let level = self.add(Expression::As { expr: level, kind: ScalarKind::Uint, convert: None });
        let math = |fun, arg, arg1| Expression::Math { fun, arg, arg1: Some(arg1), arg2: None, arg3: None };
        let level = self.add(math(naga::MathFunction::Min, level, max_level));
        let [level, one] =
            [level, one].map(|value| self.add(Expression::Splat { size: types::vector_size(count.into()), value }));
        let size = self.add(Expression::Binary { op: naga::BinaryOperator::ShiftRight, left: size, right: level });
        self.add(math(naga::MathFunction::Max, size, one))
    }

    /// Returns the shape of a channel's texture, and whether reads of it compare.
    fn texture_shape(&self, channel: u8) -> (SamplerDim, bool) {
        let texture = &self.cx.ir.textures[usize::from(channel)];
        (texture.dim, texture.shadow)
    }

    /// Splits the coordinate of a sample: in GLSL its last components are the layer and the reference value.
    fn coordinate(&mut self, whole: Handle<Expression>, dim: SamplerDim, shadow: bool) -> Coordinate {
        let size = match dim {
            SamplerDim::D1 | SamplerDim::D2 | SamplerDim::D2Array => 2,
            SamplerDim::D3 | SamplerDim::Cube => 3,
        };
        let is_array = dim == SamplerDim::D2Array;
        let depth_ref =
            shadow.then(|| self.add(Expression::AccessIndex { base: whole, index: size + u32::from(is_array) }));
        let array_index = is_array.then(|| {
            let layer = self.add(Expression::AccessIndex { base: whole, index: size });
            let fun = naga::MathFunction::Round;
            let layer = self.add(Expression::Math { fun, arg: layer, arg1: None, arg2: None, arg3: None });
            self.add(Expression::As { expr: layer, kind: ScalarKind::Sint, convert: Some(4) })
        });
        let coordinate = if is_array || shadow { self.first(whole, size) } else { whole };
        Coordinate { coordinate, array_index, depth_ref }
    }

    /// As [`Builder::coordinate`], for a fetch.
    fn texel(&mut self, whole: Handle<Expression>, dim: SamplerDim) -> Coordinate {
        if dim != SamplerDim::D2Array {
            return Coordinate { coordinate: whole, array_index: None, depth_ref: None };
        }
        let array_index = Some(self.add(Expression::AccessIndex { base: whole, index: 2 }));
        Coordinate { coordinate: self.first(whole, 2), array_index, depth_ref: None }
    }

    /// Returns the first components of a vector.
    fn first(&mut self, vector: Handle<Expression>, size: u32) -> Handle<Expression> {
        let pattern = pattern(Swizzle::new(&[0, 1, 2][..size as usize]));
        self.add(Expression::Swizzle { size: types::vector_size(size as usize), vector, pattern })
    }

    fn compose_op(&mut self, ty: TypeId, parts: &[Value]) -> Expression {
        let mut components = Vec::with_capacity(parts.len());
        let is_vector = matches!(self.cx.ir.types.get(ty), Type::Vector { .. });
        for &part in parts {
            match self.ir[part] {
                // naga's SPIR-V writer treats a constant vector within a constant vector as one component.
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
