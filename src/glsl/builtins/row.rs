//! A row of the table: all that is known of one built-in function.

use std::ops::Range;

use super::{
    constant::{Arg, Constant},
    overloads::Overload,
};
use crate::{
    ir::{Axis, Binary, Math},
    types::Scalar,
};

/// A built-in function.
#[derive(Debug)]
pub struct Row {
    pub name: &'static str,
    /// The commoner ones first.
    pub overloads: &'static [Overload],
    pub operation: Operation,
    pub constant: Constant,
    /// The arguments that it has no result for.
    pub gaps: &'static [UndefinedCase],
    /// The argument that is an `out` place.
    pub writes: Option<usize>,
    /// Section 6.1 forbids to declare a built-in again, but ANGLE, and so the site, takes overloads of these.
    pub may_be_overloaded: bool,
    /// The site defines it, in the text of Image passes alone.
    pub is_of_image: bool,
    /// Names of the parameters, for a person.
    pub params: &'static str,
    /// Explanation for a person: what it returns, where it is undefined.
    pub text: &'static str,
}

/// The values of the fields that most rows share.
pub(super) const ROW: Row = Row {
    name: "",
    overloads: &[],
    operation: Operation::Assert,
    constant: Constant::None,
    gaps: &[],
    writes: None,
    may_be_overloaded: false,
    is_of_image: false,
    params: "",
    text: "",
};

/// The code that a call becomes: `lower::builtin` writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// An operation of the intermediate representation. Scalars among its arguments stand for all components.
    Function(Math),
    Compare(Binary),
    Bitcast(Scalar),
    Derivative(Axis),
    Any,
    All,
    Not,
    /// A comparison of a float's magnitude with infinity, by their bits.
    Exponent(Binary),
    /// The arc tangent of one number or of two.
    Atan,
    Modulo,
    Modf,
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
    Assert,
}

/// The differences between the functions that sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// The coordinate's last component divides.
    pub is_projected: bool,
    pub lod: Lod,
    /// The argument that is a constant offset.
    pub offset: Option<usize>,
}

/// The level that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lod {
    /// By the derivatives of the coordinate, with or without a bias at the end.
    Implicit,
    Exact,
    Gradient,
}

/// Arguments that a function has no result for.
#[derive(Debug)]
pub struct UndefinedCase {
    /// The reason for a person, with the section of the specification.
    pub what: &'static str,
    /// The arguments that are asked for it.
    pub decides: Range<usize>,
    test: Test,
}

/// Says which arguments are in a gap.
#[derive(Debug)]
pub(super) enum Test {
    /// By the numbers of one component; NaN stands for what is no argument.
    Component(fn([f64; 3]) -> bool),
    /// By all numbers of the first argument.
    Vector(fn(&[f32]) -> bool),
}

pub(super) const fn gap(what: &'static str, decides: Range<usize>, test: Test) -> UndefinedCase {
    UndefinedCase { what, decides, test }
}

impl Row {
    /// Returns the name of parameter `index` of an overload that has `count`.
    pub fn param(&self, index: usize, count: usize) -> &'static str {
        // `atan` alone calls its one parameter something else than the first of two.
        if count == 1 && self.operation == Operation::Atan {
            return "y_over_x";
        }
        self.params.split(", ").nth(index).unwrap_or("")
    }

    /// Returns whether it reads a texture (section 8.8).
    pub fn is_texture(&self) -> bool {
        matches!(self.operation, Operation::TextureSize | Operation::Fetch { .. } | Operation::Sample(_))
    }

    /// Returns the argument that is the constant offset of a texture function.
    pub fn offset_argument(&self) -> Option<usize> {
        match self.operation {
            Operation::Fetch { offset } | Operation::Sample(Form { offset, .. }) => offset,
            _ => None,
        }
    }

    /// Returns whether a call does more than give a value.
    pub fn has_effect(&self) -> bool {
        self.writes.is_some() || self.operation == Operation::Assert
    }

    /// Returns whether it makes floats of other bits, which may stand for anything.
    pub fn reads_bits(&self) -> bool {
        matches!(self.operation, Operation::Bitcast(Scalar::Float) | Operation::Function(Math::Unpack2x16float))
    }

    /// Returns the gap that some arguments are in, and the component that is; none for a whole vector or matrix.
    pub fn gap(&self, args: &[Arg<'_>]) -> Option<(&'static UndefinedCase, Option<usize>)> {
        let components = args.iter().map(|arg| arg.words.len()).max().unwrap_or(0);
        (0..components).find_map(|index| {
            let gap = self.gaps.iter().find(|gap| gap.holds(args, index))?;
            Some((gap, matches!(gap.test, Test::Component(_)).then_some(index)))
        })
    }
}

impl UndefinedCase {
    /// Returns whether one component of the arguments is in the gap.
    pub(super) fn holds(&self, args: &[Arg<'_>], component: usize) -> bool {
        match self.test {
            Test::Component(test) => {
                let mut numbers = [f64::NAN; 3];
                numbers.iter_mut().zip(args).for_each(|(number, arg)| *number = arg.number(component));
                test(numbers)
            }
            Test::Vector(test) => test(&args[0].floats().collect::<Vec<f32>>()),
        }
    }
}
