//! Findings: numeric faults at a place of the text.

use eddy_diag::Span;

/// The `numbers` of an operation on constants.
pub(super) const CONSTANT: &str = "constant";

/// The kinds of findings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A value that is not finite, from operands that are.
    Nonfinite(&'static str),
    /// Undefined in GLSL ES 3.00: another driver may draw something else.
    Undefined(&'static str),
    /// A comparison with the opposite result in double precision.
    Decided,
    /// The operation that causes most of a pixel's difference between the precisions.
    Rounding(&'static str),
}

/// Kinds in the order in which they are reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    Nonfinite,
    Undefined,
    Rounding,
    Decided,
}

impl Kind {
    pub fn class(&self) -> Class {
        match self {
            Kind::Nonfinite(_) => Class::Nonfinite,
            Kind::Undefined(_) => Class::Undefined,
            Kind::Decided => Class::Decided,
            Kind::Rounding(_) => Class::Rounding,
        }
    }

    /// Returns the name for scripts, a single word.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Nonfinite(_) => "nonfinite",
            Kind::Undefined(_) => "undefined",
            Kind::Decided => "decided-by-rounding",
            Kind::Rounding(_) => "rounding",
        }
    }

    /// Returns the description for users.
    pub fn message(&self) -> &'static str {
        match self {
            Kind::Nonfinite(what) | Kind::Undefined(what) | Kind::Rounding(what) => what,
            Kind::Decided => "rounding decides this comparison: double precision gives the opposite result",
        }
    }
}

/// A finding at one place, in one pixel or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub kind: Kind,
    /// None for code that Eddy adds to the author's.
    pub span: Option<Span>,
    /// The number of affected pixels.
    pub pixels: usize,
    /// The most affected pixel; the first one if the kind has no measure.
    pub pixel: (u32, u32),
    /// The operands there, as in `pow(-0.5, 2)`.
    pub numbers: String,
    /// For rounding: the pixel's error, and the error that remains if the operation is exact.
    pub error: Option<(f64, f64)>,
}

impl Finding {
    /// Returns whether it is an operation on constants, which is found statically: it affects all pixels equally.
    pub fn is_constant(&self) -> bool {
        self.numbers == CONSTANT
    }

    pub(super) fn is_same_as(&self, other: &Finding) -> bool {
        self.kind == other.kind && self.span == other.span
    }

    pub(super) fn add(&mut self, other: &Finding) {
        self.pixels += other.pixels;
        if other.error.map(|e| e.0) > self.error.map(|e| e.0) {
            (self.error, self.pixel) = (other.error, other.pixel);
            self.numbers.clone_from(&other.numbers);
        }
    }
}
