//! A row of the table: everything that is known about one built-in function.

use std::ops::Range;

use super::{
    constant::{Arg, Constant},
    overloads::Overload,
};
use crate::{
    ir::{Axis, Binary, Detail, Math},
    types::Scalar,
};

/// A built-in function.
#[derive(Debug)]
pub struct Row {
    pub name: &'static str,
    /// The more common ones first.
    pub overloads: &'static [Overload],
    /// Overloads that only GLSL 4.50 and later versions have.
    pub later_overloads: &'static [Overload],
    pub operation: Operation,
    pub constant: Constant,
    /// The arguments for which the result is undefined.
    pub undefined_for: &'static [UndefinedDomain],
    /// The arguments that are `out` places.
    pub writes: &'static [usize],
    /// Section 6.1 forbids redeclaring a built-in, but ANGLE, and therefore Shadertoy, accepts overloads of these.
    pub may_be_overloaded: bool,
    /// Shadertoy defines it, only in the text of Image passes.
    pub is_of_image: bool,
    /// The version of GLSL that has it, if GLSL ES 3.00 does not have it; otherwise 0.
    pub since: u16,
    /// Names of the parameters, as shown to users.
    pub params: &'static str,
    /// Explanation for users: what it returns, where it is undefined.
    pub text: &'static str,
}

/// The values of the fields that most rows share.
pub(super) const ROW: Row = Row {
    name: "",
    overloads: &[],
    later_overloads: &[],
    operation: Operation::Assert,
    constant: Constant::None,
    undefined_for: &[],
    writes: &[],
    may_be_overloaded: false,
    is_of_image: false,
    since: 0,
    params: "",
    text: "",
};

/// The code that a call becomes; written by `lower::builtin`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// An operation of the intermediate representation. Scalar arguments are broadcast to all components.
    Function(Math),
    Compare(Binary),
    Bitcast(Scalar),
    Derivative(Axis, Detail),
    Any,
    All,
    Not,
    /// A comparison of a float's magnitude with infinity, on their bits.
    Exponent(Binary),
    /// The arc tangent of one number or of two.
    Atan,
    Modulo,
    Modf,
    Fma,
    /// A variable of an earlier stage at another place in the pixel.
    Interpolate,
    Frexp,
    Ldexp,
    /// A function of an int's or a uint's bits whose result is an int.
    BitPosition(Math),
    BitfieldExtract,
    BitfieldInsert,
    AddCarry,
    SubtractBorrow,
    MultiplyExtended,
    Mix,
    Step,
    Smoothstep,
    Length,
    Distance,
    Dot,
    Normalize,
    FaceForward,
    Reflect,
    Refract,
    MatrixCompMult,
    OuterProduct,
    Determinant,
    Inverse,
    TextureSize,
    Fetch {
        offset: Option<usize>,
    },
    Sample(Form),
    Gather {
        offset: Option<usize>,
    },
    QueryLevels,
    QueryLod,
    Assert,
}

/// The variants of the sampling functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// The coordinate is divided by its last component.
    pub is_projected: bool,
    pub lod: Lod,
    /// The argument that is a constant offset.
    pub offset: Option<usize>,
}

/// The mip level that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lod {
    /// From the derivatives of the coordinate, with or without a bias as the last argument.
    Implicit,
    Exact,
    Gradient,
}

/// Arguments for which a function's result is undefined.
#[derive(Debug)]
pub struct UndefinedDomain {
    /// The reason for users, with the section of the specification.
    pub what: &'static str,
    /// The arguments that are tested.
    pub decides: Range<usize>,
    test: Test,
}

/// The test for arguments in a gap.
#[derive(Debug)]
pub(super) enum Test {
    /// On the numbers of one component; NaN for missing arguments.
    Component(fn([f64; 4]) -> bool),
    /// On all numbers of the first argument.
    Vector(fn(&[f32]) -> bool),
}

pub(super) const fn gap(what: &'static str, decides: Range<usize>, test: Test) -> UndefinedDomain {
    UndefinedDomain { what, decides, test }
}

impl Row {
    /// Returns the name of parameter `index` of an overload that has `count`.
    pub fn param(&self, index: usize, count: usize) -> &'static str {
        // Only `atan` names its single parameter differently from the first of two.
        if count == 1 && self.operation == Operation::Atan {
            return "y_over_x";
        }
        self.params.split(", ").nth(index).unwrap_or("")
    }

    /// Returns whether it reads a texture (section 8.8).
    pub fn is_texture(&self) -> bool {
        use Operation::*;
        matches!(self.operation, TextureSize | Fetch { .. } | Sample(_) | Gather { .. } | QueryLevels | QueryLod)
    }

    /// Returns the argument that is the constant offset of a texture function.
    pub fn offset_argument(&self) -> Option<usize> {
        match self.operation {
            Operation::Fetch { offset } | Operation::Gather { offset } | Operation::Sample(Form { offset, .. }) => {
                offset
            }
            _ => None,
        }
    }

    /// Returns the last of `count` arguments if it is the component that is gathered, or, as a float, the reference value
    /// of a comparison.
    pub fn component_argument(&self, count: usize) -> Option<usize> {
        let Operation::Gather { offset } = self.operation else { return None };
        let at = 2 + usize::from(offset.is_some());
        (count > at).then_some(at)
    }

    /// Returns whether a call has an effect besides its value.
    pub fn has_effect(&self) -> bool {
        !self.writes.is_empty() || self.operation == Operation::Assert
    }

    /// Returns whether it reinterprets bits as floats, which may be any value.
    pub fn reads_bits(&self) -> bool {
        matches!(self.operation, Operation::Bitcast(Scalar::Float) | Operation::Function(Math::Unpack2x16float))
    }

    /// Returns the gap that the arguments are in, and the component that is; no component for a whole vector or matrix.
    pub fn gap(&self, args: &[Arg<'_>]) -> Option<(&'static UndefinedDomain, Option<usize>)> {
        let components = args.iter().map(|arg| arg.words.len()).max().unwrap_or(0);
        (0..components).find_map(|index| {
            let gap = self.undefined_for.iter().find(|gap| gap.holds(args, index))?;
            Some((gap, matches!(gap.test, Test::Component(_)).then_some(index)))
        })
    }
}

impl UndefinedDomain {
    /// Returns whether one component of the arguments is in the gap.
    pub(super) fn holds(&self, args: &[Arg<'_>], component: usize) -> bool {
        match self.test {
            Test::Component(test) => {
                let mut numbers = [f64::NAN; 4];
                numbers.iter_mut().zip(args).for_each(|(number, arg)| *number = arg.number(component));
                test(numbers)
            }
            Test::Vector(test) => test(&args[0].floats().collect::<Vec<f32>>()),
        }
    }
}
