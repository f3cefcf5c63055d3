//! Translates operators and functions of the IR to naga's.

use naga::{BinaryOperator, MathFunction, SwizzleComponent, UnaryOperator};

use crate::{
    ir::{Binary, Math, Unary},
    types::Swizzle,
};

/// The components of a vector, in order.
pub(super) const XYZW: [SwizzleComponent; 4] =
    [SwizzleComponent::X, SwizzleComponent::Y, SwizzleComponent::Z, SwizzleComponent::W];

pub(super) fn pattern(swizzle: Swizzle) -> [SwizzleComponent; 4] {
    let mut pattern = [SwizzleComponent::X; 4];
    for (i, component) in swizzle.iter().enumerate() {
        pattern[i] = XYZW[component];
    }
    pattern
}

pub(super) fn unary(op: Unary) -> UnaryOperator {
    match op {
        Unary::Negate => UnaryOperator::Negate,
        Unary::LogicalNot => UnaryOperator::LogicalNot,
        Unary::BitwiseNot => UnaryOperator::BitwiseNot,
    }
}

pub(super) fn binary(op: Binary) -> BinaryOperator {
    use BinaryOperator as To;
    match op {
        Binary::Add => To::Add,
        Binary::Subtract => To::Subtract,
        Binary::Multiply => To::Multiply,
        Binary::Divide => To::Divide,
        Binary::Modulo => To::Modulo,
        Binary::Equal => To::Equal,
        Binary::NotEqual => To::NotEqual,
        Binary::Less => To::Less,
        Binary::LessEqual => To::LessEqual,
        Binary::Greater => To::Greater,
        Binary::GreaterEqual => To::GreaterEqual,
        Binary::And => To::And,
        Binary::ExclusiveOr => To::ExclusiveOr,
        Binary::InclusiveOr => To::InclusiveOr,
        Binary::LogicalAnd => To::LogicalAnd,
        Binary::ShiftLeft => To::ShiftLeft,
        Binary::ShiftRight => To::ShiftRight,
    }
}

pub(super) fn math(fun: Math) -> MathFunction {
    use MathFunction as To;
    match fun {
        Math::Abs => To::Abs,
        Math::Sign => To::Sign,
        Math::Floor => To::Floor,
        Math::Ceil => To::Ceil,
        Math::Trunc => To::Trunc,
        Math::Round => To::Round,
        Math::Fract => To::Fract,
        Math::Min => To::Min,
        Math::Max => To::Max,
        Math::Clamp => To::Clamp,
        Math::Saturate => To::Saturate,
        Math::Mix => To::Mix,
        Math::SmoothStep => To::SmoothStep,
        Math::Sqrt => To::Sqrt,
        Math::InverseSqrt => To::InverseSqrt,
        Math::Pow => To::Pow,
        Math::Exp => To::Exp,
        Math::Exp2 => To::Exp2,
        Math::Log => To::Log,
        Math::Log2 => To::Log2,
        Math::Radians => To::Radians,
        Math::Degrees => To::Degrees,
        Math::Sin => To::Sin,
        Math::Cos => To::Cos,
        Math::Tan => To::Tan,
        Math::Asin => To::Asin,
        Math::Acos => To::Acos,
        Math::Atan => To::Atan,
        Math::Atan2 => To::Atan2,
        Math::Sinh => To::Sinh,
        Math::Cosh => To::Cosh,
        Math::Tanh => To::Tanh,
        Math::Asinh => To::Asinh,
        Math::Acosh => To::Acosh,
        Math::Atanh => To::Atanh,
        Math::Cross => To::Cross,
        Math::Length => To::Length,
        Math::Normalize => To::Normalize,
        Math::FaceForward => To::FaceForward,
        Math::Determinant => To::Determinant,
        Math::Transpose => To::Transpose,
        Math::Pack2x16snorm => To::Pack2x16snorm,
        Math::Pack2x16unorm => To::Pack2x16unorm,
        Math::Pack2x16float => To::Pack2x16float,
        Math::Unpack2x16snorm => To::Unpack2x16snorm,
        Math::Unpack2x16unorm => To::Unpack2x16unorm,
        Math::Unpack2x16float => To::Unpack2x16float,
        Math::Pack4x8snorm => To::Pack4x8snorm,
        Math::Pack4x8unorm => To::Pack4x8unorm,
        Math::Unpack4x8snorm => To::Unpack4x8snorm,
        Math::Unpack4x8unorm => To::Unpack4x8unorm,
        Math::CountOneBits => To::CountOneBits,
        Math::ReverseBits => To::ReverseBits,
        Math::FirstTrailingBit => To::FirstTrailingBit,
        Math::FirstLeadingBit => To::FirstLeadingBit,
        Math::ExtractBits => To::ExtractBits,
        Math::InsertBits => To::InsertBits,
    }
}
