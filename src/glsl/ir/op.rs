//! Operations, which compute values.

use super::ids::{ConstId, FuncId, GlobalId, Value, VarId};
use crate::types::{Scalar, Swizzle, TypeId};

/// The operation that computes a value. Operands have the types documented for each op; `verify` checks them.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    // Free: these are not computed by a statement.
    /// A scalar, bit for bit; bools are 0 or 1.
    Literal(Scalar, u32),
    /// All zeros, of any type.
    Zero(TypeId),
    /// A constant of the module.
    Const(ConstId),
    /// A parameter: a value, or an address.
    Param(u32),
    /// The address of a variable of the function.
    Var(VarId),
    /// The address of a variable of the module.
    Global(GlobalId),
    /// A value that the device passes to the entry point.
    Input(Input),

    // Parts of values and of places.
    /// A member, an element, a column or a component, at an index that is in range.
    Part { base: Value, index: u32 },
    /// The same at an index, int or uint, that is known only at run time. Of values only vectors can be indexed so.
    Element { base: Value, index: Value },
    /// Two to four components of a vector.
    Swizzle { vector: Value, swizzle: Swizzle },
    /// A vector of `size` equal components.
    Splat { size: u8, value: Value },
    /// A value composed of its parts, in order. The parts of a vector may themselves be vectors.
    Compose { ty: TypeId, parts: Box<[Value]> },

    // Arithmetic.
    /// An operator on one value, component by component.
    Unary { op: Unary, operand: Value },
    /// An operator on two values.
    Binary { op: Binary, left: Value, right: Value },
    /// A function that the device provides, with the number of arguments that it takes.
    Math { fun: Math, arg: Value, arg1: Option<Value>, arg2: Option<Value>, arg3: Option<Value> },
    /// One of two values of one type; `condition` is a bool, or a vector of bools of the same size.
    Select { condition: Value, accept: Value, reject: Value },
    /// A scalar or vector converted to another component type.
    Convert { value: Value, to: Scalar },
    /// The same bits as another 32-bit component type.
    Bitcast { value: Value, to: Scalar },
    /// True where all components of a vector of bools are true.
    All(Value),
    /// True where some component of a vector of bools is true.
    Any(Value),
    /// The derivative of a float between neighbouring pixels.
    Derivative { axis: Axis, detail: Detail, value: Value },

    // Textures: of a channel, 0 to 3.
    /// A filtered read.
    Sample { channel: u8, coordinate: Value, level: Level, offset: Option<Value> },
    /// One component of the four texels that a filtered read of the base level mixes.
    Gather { channel: u8, component: u8, coordinate: Value, offset: Option<Value> },
    /// A texel; zeros outside of the texture.
    Fetch { channel: u8, coordinate: Value, level: Value },
    /// Ints.
    TextureSize { channel: u8, level: Option<Value> },
    /// A uint.
    TextureLevels { channel: u8 },

    // Memory and calls.
    /// The value at a place.
    Load { place: Value },
    /// Void if the function is; the argument of a parameter by reference is a place.
    Call { function: FuncId, args: Box<[Value]> },

    // Barriers.
    /// The int 0, unknown to every later compiler.
    OpaqueZero,
}

/// A value that the device passes to an entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Input {
    /// `vec4`: the position of a fragment.
    Position,
    /// `uint`.
    VertexIndex,
    /// `uint`.
    InstanceIndex,
    /// `bool`.
    FrontFacing,
    /// A vertex attribute.
    Attribute { location: u32, ty: TypeId },
    /// An output of the vertex stage.
    Varying { location: u32, ty: TypeId, flat: bool },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    Negate,
    LogicalNot,
    BitwiseNot,
}

/// Operators on scalars and vectors of one type. `Multiply` also takes a float scalar and a vector or matrix, in either
/// order, and sums and differences take two matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    /// For ints and uints: the remainder of the division that rounds down, which has the divisor's sign.
    Modulo,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    And,
    ExclusiveOr,
    InclusiveOr,
    LogicalAnd,
    /// The right side is a uint below 32.
    ShiftLeft,
    ShiftRight,
}

impl Binary {
    /// Returns whether the result is a bool for each component.
    pub fn is_comparison(self) -> bool {
        use Binary::*;
        matches!(self, Equal | NotEqual | Less | LessEqual | Greater | GreaterEqual)
    }
}

/// Functions of numbers: those of chapter 8, in GLSL ES 3.00 and later versions, that graphics APIs have too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Math {
    Abs,
    Sign,
    Floor,
    Ceil,
    Trunc,
    Round,
    Fract,
    Min,
    Max,
    Clamp,
    Saturate,
    Mix,
    SmoothStep,
    Sqrt,
    InverseSqrt,
    Pow,
    Exp,
    Exp2,
    Log,
    Log2,
    Radians,
    Degrees,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    /// `atan(y, x)`.
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Cross,
    Length,
    Normalize,
    FaceForward,
    Determinant,
    Transpose,
    Pack2x16snorm,
    Pack2x16unorm,
    Pack2x16float,
    Unpack2x16snorm,
    Unpack2x16unorm,
    Unpack2x16float,
    Pack4x8snorm,
    Pack4x8unorm,
    Unpack4x8snorm,
    Unpack4x8unorm,
    CountOneBits,
    ReverseBits,
    /// The position of the lowest bit that is 1; all ones for 0.
    FirstTrailingBit,
    /// The position of the highest bit that differs from the sign, or of the highest 1 of a uint; all ones without one.
    FirstLeadingBit,
    /// `extract(x, offset, count)`, with uints that are clamped to the 32 bits.
    ExtractBits,
    /// `insert(x, new, offset, count)`, with uints that are clamped to the 32 bits.
    InsertBits,
}

impl Math {
    /// Returns whether each component of the result depends only on the same component of the operands.
    pub fn is_componentwise(self) -> bool {
        use Math::*;
        !matches!(
            self,
            Cross
                | Length
                | Normalize
                | FaceForward
                | Determinant
                | Transpose
                | Pack2x16snorm
                | Pack2x16unorm
                | Pack2x16float
                | Unpack2x16snorm
                | Unpack2x16unorm
                | Unpack2x16float
                | Pack4x8snorm
                | Pack4x8unorm
                | Unpack4x8snorm
                | Unpack4x8unorm
                | ExtractBits
                | InsertBits
        )
    }
}

/// A direction of a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    X,
    Y,
    /// The sum of the magnitudes along both.
    Width,
}

/// The pixels whose difference is a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Detail {
    /// The device chooses.
    Any,
    /// The same for all pixels of a quad.
    Coarse,
    /// The pixel's own row or column.
    Fine,
}

/// The mip level that a sample reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// From the derivatives of the coordinate.
    Auto,
    /// This level.
    Exact(Value),
    /// This bias added to the level from the derivatives.
    Bias(Value),
    /// From these derivatives of the coordinate.
    Gradient { x: Value, y: Value },
}

/// Calls `$visit` with a reference to each operand of the operation that `$op` refers to; `$iter` is `iter` or
/// `iter_mut`.
macro_rules! each_operand {
    ($op:expr, $visit:ident, $iter:ident) => {{
        use Op::*;
        match $op {
            Literal(..)
            | Zero(_)
            | Const(_)
            | Param(_)
            | Var(_)
            | Global(_)
            | Input(_)
            | TextureLevels { .. }
            | OpaqueZero => {}
            Compose { parts: all, .. } | Call { args: all, .. } => all.$iter().for_each($visit),
            Element { base: a, index: b }
            | Binary { left: a, right: b, .. }
            | Fetch { coordinate: a, level: b, .. } => {
                $visit(a);
                $visit(b);
            }
            Part { base: a, .. }
            | Swizzle { vector: a, .. }
            | Splat { value: a, .. }
            | Unary { operand: a, .. }
            | Convert { value: a, .. }
            | Bitcast { value: a, .. }
            | All(a)
            | Any(a)
            | Derivative { value: a, .. }
            | Load { place: a } => $visit(a),
            Select { condition, accept, reject } => [condition, accept, reject].into_iter().for_each($visit),
            Math { arg, arg1, arg2, arg3, .. } => {
                $visit(arg);
                [arg1, arg2, arg3].into_iter().flatten().for_each($visit);
            }
            Sample { coordinate, level, offset, .. } => {
                $visit(coordinate);
                match level {
                    Level::Auto => {}
                    Level::Exact(level) | Level::Bias(level) => $visit(level),
                    Level::Gradient { x, y } => {
                        $visit(x);
                        $visit(y);
                    }
                }
                offset.$iter().for_each($visit);
            }
            Gather { coordinate, offset, .. } => {
                $visit(coordinate);
                offset.$iter().for_each($visit);
            }
            TextureSize { level, .. } => level.$iter().for_each($visit),
        }
    }};
}

impl Op {
    /// Returns whether the value exists from the start of its function, without a statement.
    pub fn is_free(&self) -> bool {
        use Op::*;
        matches!(self, Literal(..) | Zero(_) | Const(_) | Param(_) | Var(_) | Global(_) | Input(_))
    }

    /// Visits the operands, in order.
    pub fn operands(&self, mut visit: impl FnMut(Value)) {
        let mut visit = |value: &Value| visit(*value);
        each_operand!(self, visit, iter);
    }

    /// Visits the operands, in order; each may be changed.
    pub fn operands_mut(&mut self, mut visit: impl FnMut(&mut Value)) {
        each_operand!(self, visit, iter_mut);
    }
}

const _: () = assert!(size_of::<Op>() <= 32);
