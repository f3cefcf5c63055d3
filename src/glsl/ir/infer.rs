//! Type inference for ops.

use super::{Binary, Function, Input, Math, Module, Op, Unary, Value};
use crate::types::{Scalar, Type, TypeId};

/// Returns the type of an op of this function; for a place, the type of its contents.
pub fn ty(module: &Module, function: &Function, op: &Op) -> TypeId {
    let of = |value: Value| function.ty(value);
    let size = |value: Value| (module.types.components(of(value)).unwrap_or(1)) as u8;
    match *op {
        Op::Literal(scalar, _) => TypeId::vector(scalar, 1),
        Op::Zero(ty) | Op::Compose { ty, .. } => ty,
        Op::Const(id) => module[id].ty,
        Op::Param(index) => function.params[index as usize].ty,
        Op::Var(id) => function.vars[id.index()].ty,
        Op::Global(id) => module[id].ty,
        Op::Input(Input::Position) => TypeId::VEC4,
        Op::Input(Input::VertexIndex | Input::InstanceIndex) | Op::TextureLevels { .. } => TypeId::UINT,
        Op::Input(Input::FrontFacing) | Op::All(_) | Op::Any(_) => TypeId::BOOL,
        Op::Input(Input::Attribute { ty, .. } | Input::Varying { ty, .. }) => ty,
        Op::Part { base, index } => module.part(of(base), index),
        Op::Element { base, .. } => module.part(of(base), 0),
        Op::Swizzle { vector, swizzle } => TypeId::vector(module.scalar(of(vector)), swizzle.len() as u8),
        Op::Splat { size, value } => TypeId::vector(module.scalar(of(value)), size),
        Op::Unary { op: Unary::LogicalNot | Unary::Negate | Unary::BitwiseNot, operand } => of(operand),
        Op::Binary { op, left, right } => {
            if op.is_comparison() {
                return TypeId::vector(Scalar::Bool, size(left));
            }
            if matches!(op, Binary::ShiftLeft | Binary::ShiftRight) {
                return of(left);
            }
            // A scalar is combined with each component of the other side.
            match module.types.get(of(left)) {
                Type::Scalar(_) => of(right),
                _ => of(left),
            }
        }
        Op::Math { fun, arg, .. } => math(module, fun, of(arg)),
        Op::Select { accept, .. } => of(accept),
        Op::Convert { value, to } | Op::Bitcast { value, to } => TypeId::vector(to, size(value)),
        Op::Derivative { value, .. } => of(value),
        Op::Sample { channel, .. } | Op::Fetch { channel, .. } => module.texel(channel),
        Op::Gather { channel, .. } => TypeId::vector(module.scalar(module.texel(channel)), 4),
        Op::TextureSize { .. } => unreachable!("its type is the channel's"),
        Op::Load { place } => of(place),
        Op::Call { function, .. } => module[function].result,
        Op::OpaqueZero => TypeId::INT,
    }
}

fn math(module: &Module, fun: Math, arg: TypeId) -> TypeId {
    match fun {
        Math::Length | Math::Determinant => TypeId::FLOAT,
        Math::Pack2x16snorm | Math::Pack2x16unorm | Math::Pack2x16float | Math::Pack4x8snorm | Math::Pack4x8unorm => {
            TypeId::UINT
        }
        Math::Unpack2x16snorm | Math::Unpack2x16unorm | Math::Unpack2x16float => TypeId::VEC2,
        Math::Unpack4x8snorm | Math::Unpack4x8unorm => TypeId::VEC4,
        Math::Transpose => match module.types.get(arg) {
            Type::Matrix { columns, rows } => TypeId::matrix(rows, columns),
            _ => arg,
        },
        _ => arg,
    }
}
