//! A finding says what is wrong at a place of the text.

use eddy_diag::Span;

/// The numbers of an operation on constants.
pub(super) const CONSTANT: &str = "constant";

/// The kinds of findings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A value that is no finite number, of operands that are.
    Nonfinite(&'static str),
    /// GLSL ES 3.00 leaves the result open: another driver may draw something else.
    Undefined(&'static str),
    /// A comparison that comes out the other way in double precision.
    Decided,
    /// The operation in which most of a pixel's difference between the precisions is born.
    Rounding(&'static str),
}

/// Kinds in the order in which they are told.
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

    /// One word for scripts.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Nonfinite(_) => "nonfinite",
            Kind::Undefined(_) => "undefined",
            Kind::Decided => "decided-by-rounding",
            Kind::Rounding(_) => "rounding",
        }
    }

    /// Returns what it is, for a person.
    pub fn message(&self) -> &'static str {
        match self {
            Kind::Nonfinite(what) | Kind::Undefined(what) | Kind::Rounding(what) => what,
            Kind::Decided => "rounding decides this comparison: double precision gives the opposite result",
        }
    }
}

/// Something found at a place, in one pixel or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub kind: Kind,
    /// None for what Eddy adds to the author's code.
    pub span: Option<Span>,
    /// The number of the pixels that show it.
    pub pixels: usize,
    /// The one that shows it most; where that is no question, the first.
    pub pixel: (u32, u32),
    /// The numbers there, as in `pow(-0.5, 2)`.
    pub numbers: String,
    /// For rounding: the pixel's error, and what is left of it where the operation is exact.
    pub error: Option<(f64, f64)>,
}

impl Finding {
    /// It is an operation on constants, which is found in the text: no pixel shows it more than another.
    pub fn is_constant(&self) -> bool {
        self.numbers == CONSTANT
    }

    pub(super) fn is_like(&self, other: &Finding) -> bool {
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
