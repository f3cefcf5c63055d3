//! The operations, each with its exact result and the error bounds of devices.
//!
//! The bounds are those of the Vulkan specification, "Precision and Operation of SPIR-V Instructions", which WGSL's
//! "Floating Point Accuracy" repeats; `lavapipe` is the measured bound of Mesa's software driver where it differs.

use super::operands::{COUNT, Span};

pub(super) type Vector = [f64; 4];
pub(super) type Operands = [Vector; COUNT];

/// The implementation whose bounds apply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grade {
    /// Any device.
    Vulkan,
    Lavapipe,
    Walker,
}

/// The largest allowed error of a result.
#[derive(Clone, Copy)]
pub(super) enum Bound {
    /// Correctly rounded to single precision.
    Rounded,
    Ulps(f64),
    Absolute(f64),
    /// An absolute error that follows from the operands and the exact result.
    Each(fn(f64, f64, f64) -> f64),
    /// A number of roundings of a sum of terms, and the sums of the terms' magnitudes: for sums in any order.
    Terms(f64, fn(&Operands) -> Vector),
}

/// The exact results, in double precision.
#[derive(Clone, Copy)]
pub(super) enum Exact {
    /// Component by component.
    Each(fn(f64, f64, f64) -> f64),
    Whole(fn(&Operands) -> Vector),
}

pub(super) struct Operation {
    pub name: &'static str,
    /// An expression over `a`, `b` and `c`.
    pub text: &'static str,
    pub spans: [Span; COUNT],
    pub exact: Exact,
    pub vulkan: Bound,
    /// The source of the bound.
    pub source: &'static str,
    pub lavapipe: Bound,
    pub walker: Bound,
}

impl Operation {
    pub(super) fn exact(&self, operands: &Operands) -> Vector {
        match self.exact {
            Exact::Each(each) => std::array::from_fn(|i| each(operands[0][i], operands[1][i], operands[2][i])),
            Exact::Whole(whole) => whole(operands),
        }
    }

    pub(super) fn bound(&self, grade: Grade) -> Bound {
        match grade {
            Grade::Vulkan => self.vulkan,
            Grade::Lavapipe => self.lavapipe,
            Grade::Walker => self.walker,
        }
    }
}

/// Returns the distance between neighbouring single-precision numbers at `at`.
pub(super) fn ulp(at: f64) -> f64 {
    let exponent = at.abs().max(f64::from(f32::MIN_POSITIVE)).log2().floor();
    (exponent - 23.0).exp2()
}

/// Half the distance between neighbouring numbers, relative to the lesser one.
pub(super) const ROUNDING: f64 = 1.0 / (1u32 << 24) as f64;

impl Bound {
    /// Returns the allowed absolute error of a component.
    pub(super) fn allowed(&self, operands: &Operands, i: usize, exact: f64) -> f64 {
        // Half a ULP, plus a margin for the rounding of double precision.
        let half = 0.5 * ulp(exact) * (1.0 + 1e-6);
        match *self {
            Bound::Rounded => half,
            Bound::Ulps(count) => count * ulp(exact),
            Bound::Absolute(by) => by.max(half),
            Bound::Each(each) => each(operands[0][i], operands[1][i], exact).max(half),
            Bound::Terms(roundings, terms) => roundings * ROUNDING * terms(operands)[i],
        }
    }
}

/// Numbers whose sums and products are far from overflow and underflow.
const MIDDLE: Span = Span::new(-30, 30).signed().or_zero();
/// All numbers except subnormal ones.
const ALL: Span = Span::new(-126, 127).signed().or_zero();
const POSITIVE: Span = Span::new(-126, 127);
const SMALL: Span = Span::new(-3, 3).signed().or_zero();
const UNIT: Span = Span::new(-12, -1).or_zero();

const fn row(
    name: &'static str,
    text: &'static str,
    span: Span,
    exact: Exact,
    vulkan: Bound,
    source: &'static str,
) -> Operation {
    Operation { name, text, spans: [span; COUNT], exact, vulkan, source, lavapipe: vulkan, walker: Bound::Ulps(1.0) }
}

/// An operation that IEEE 754 defines exactly.
const fn rounded(name: &'static str, text: &'static str, span: Span, each: fn(f64, f64, f64) -> f64) -> Operation {
    let row = row(name, text, span, Exact::Each(each), Bound::Rounded, "correctly rounded");
    Operation { walker: Bound::Rounded, ..row }
}

/// A sum of products, or a function of one.
const fn whole(
    (name, text): (&'static str, &'static str),
    span: Span,
    exact: fn(&Operands) -> Vector,
    (roundings, terms): (f64, fn(&Operands) -> Vector),
    source: &'static str,
) -> Operation {
    let bound = Bound::Terms(roundings, terms);
    Operation { walker: bound, ..row(name, text, span, Exact::Whole(exact), bound, source) }
}

/// `exp` and `exp2`: 3 + 2 |x| ULPs.
fn exponential(x: f64, _: f64, exact: f64) -> f64 {
    (3.0 + 2.0 * x.abs()) * ulp(exact)
}

/// `log` and `log2`: 3 ULPs; between 0.5 and 2, 2^-21.
fn logarithm(x: f64, _: f64, exact: f64) -> f64 {
    if (0.5..=2.0).contains(&x) { (-21f64).exp2() } else { 3.0 * ulp(exact) }
}

/// `pow`: the bound of `exp2(y * log2(x))`.
fn power(x: f64, y: f64, exact: f64) -> f64 {
    let log = x.log2();
    let exponent = y * log;
    let error = y.abs() * logarithm(x, 0.0, log) + ulp(exponent) / 2.0;
    exact * (error.exp2() - 1.0) + exponential(exponent, 0.0, exact)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the sum of the magnitudes of a dot product's terms.
fn size(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum()
}

/// Multiplies a matrix of two columns by a vector.
fn multiply(m: &Vector, v: &[f64], product: fn(&[f64], &[f64]) -> f64) -> [f64; 2] {
    [0, 1].map(|row| product(&[m[row], m[row + 2]], &v[..2]))
}

fn cross(a: &Vector, b: &Vector, join: fn(f64, f64) -> f64) -> Vector {
    let part = |(i, j): (usize, usize)| join(a[i] * b[j], a[j] * b[i]);
    [part((1, 2)), part((2, 0)), part((0, 1)), 0.0]
}

pub(super) fn operations() -> Vec<Operation> {
    const VULKAN: &str = "3 + 2 |x| ULPs";
    const LOG: &str = "3 ULPs, in [0.5, 2] by 2^-21";
    let each = |name, text, span, exact, vulkan, source| row(name, text, span, Exact::Each(exact), vulkan, source);
    let mut operations = vec![
        rounded("a + b", "a + b", MIDDLE, |a, b, _| a + b),
        rounded("a - b", "a - b", MIDDLE, |a, b, _| a - b),
        rounded("a * b", "a * b", MIDDLE, |a, b, _| a * b),
        rounded("a + b, to the ends", "a + b", ALL, |a, b, _| a + b),
        rounded("a * b, to the ends", "a * b", ALL, |a, b, _| a * b),
        Operation {
            walker: Bound::Rounded,
            lavapipe: Bound::Rounded,
            ..each("a / b", "a / b", Span::new(-30, 30).signed(), |a, b, _| a / b, Bound::Ulps(2.5), "2.5 ULPs")
        },
        rounded("floor", "floor(a)", ALL, |a, _, _| a.floor()),
        rounded("ceil", "ceil(a)", ALL, |a, _, _| a.ceil()),
        rounded("trunc", "trunc(a)", ALL, |a, _, _| a.trunc()),
        rounded("roundEven", "roundEven(a)", SMALL, |a, _, _| a.round_ties_even()),
        rounded("fract", "fract(a)", MIDDLE, |a, _, _| a - a.floor()),
        rounded("abs, sign", "abs(a) * sign(b)", MIDDLE, |a, b, _| if b == 0.0 { 0.0 } else { a.abs() * b.signum() }),
        rounded("min", "min(a, b)", ALL, |a, b, _| a.min(b)),
        rounded("max", "max(a, b)", ALL, |a, b, _| a.max(b)),
        rounded("clamp", "clamp(a, min(b, c), max(b, c))", ALL, |a, b, c| a.max(b.min(c)).min(b.max(c))),
        rounded("step", "step(a, b)", SMALL, |a, b, _| f64::from(b >= a)),
        Operation {
            spans: [Span::new(0, 10).signed(), Span::new(-2, 4).signed(), SMALL],
            ..whole(
                ("mod", "mod(a, b)"),
                SMALL,
                |[a, b, _]| std::array::from_fn(|i| a[i] - b[i] * (a[i] / b[i]).floor()),
                // A quotient near a whole number may be rounded to it: then the error is up to `b`.
                (2.0, |[a, b, _]| {
                    std::array::from_fn(|i| {
                        let quotient = a[i] / b[i];
                        let is_near = (quotient - quotient.round()).abs() <= 5.0 * ROUNDING * quotient.abs();
                        a[i].abs() + b[i].abs() + if is_near { b[i].abs() / ROUNDING } else { 0.0 }
                    })
                }),
                "that of a - b * floor(a / b)",
            )
        },
        Operation {
            walker: Bound::Rounded,
            ..each("sqrt", "sqrt(a)", POSITIVE, |a, _, _| a.sqrt(), Bound::Ulps(5.0), "that of 1 / inversesqrt(a)")
        },
        Operation {
            walker: Bound::Ulps(1.5),
            ..each("inversesqrt", "inversesqrt(a)", POSITIVE, |a, _, _| 1.0 / a.sqrt(), Bound::Ulps(2.0), "2 ULPs")
        },
        each(
            "exp2",
            "exp2(a)",
            Span::new(-20, 6).signed().or_zero(),
            |a, _, _| a.exp2(),
            Bound::Each(exponential),
            VULKAN,
        ),
        each(
            "exp",
            "exp(a)",
            Span::new(-20, 5).signed().or_zero(),
            |a, _, _| a.exp(),
            Bound::Each(exponential),
            VULKAN,
        ),
        each("log2", "log2(a)", POSITIVE, |a, _, _| a.log2(), Bound::Each(logarithm), LOG),
        each("log2 near 1", "log2(a)", Span::new(-1, 0), |a, _, _| a.log2(), Bound::Each(logarithm), LOG),
        each("log", "log(a)", POSITIVE, |a, _, _| a.ln(), Bound::Each(logarithm), LOG),
        Operation {
            spans: [Span::new(-6, 6), Span::new(-4, 3).signed().or_zero(), SMALL],
            ..each("pow", "pow(a, b)", SMALL, |a, b, _| a.powf(b), Bound::Each(power), "that of exp2(b * log2(a))")
        },
        each(
            "sin",
            "sin(a)",
            Span::new(-20, 0).signed().or_zero(),
            |a, _, _| a.sin(),
            Bound::Absolute(SINE),
            "2^-11 in [-pi, pi]",
        ),
        each(
            "cos",
            "cos(a)",
            Span::new(-20, 0).signed().or_zero(),
            |a, _, _| a.cos(),
            Bound::Absolute(SINE),
            "2^-11 in [-pi, pi]",
        ),
        each("sin to 2^13", "sin(a)", Span::new(1, 12).signed(), |a, _, _| a.sin(), Bound::Absolute(2.0), "none"),
        each("cos to 2^13", "cos(a)", Span::new(1, 12).signed(), |a, _, _| a.cos(), Bound::Absolute(2.0), "none"),
        each("sin to 2^24", "sin(a)", Span::new(13, 23).signed(), |a, _, _| a.sin(), Bound::Absolute(2.0), "none"),
        each(
            "tan",
            "tan(a)",
            Span::new(-20, -1).signed().or_zero(),
            |a, _, _| a.tan(),
            Bound::Absolute(4.0 * SINE),
            "that of sin(a) / cos(a)",
        ),
        each("atan", "atan(a)", MIDDLE, |a, _, _| a.atan(), Bound::Ulps(4096.0), "4096 ULPs"),
        // glibc's manual states two ULPs for atan2f.
        Operation {
            walker: Bound::Ulps(2.0),
            ..each(
                "atan of two",
                "atan(a, b)",
                Span::new(-10, 10).signed(),
                |a, b, _| a.atan2(b),
                Bound::Ulps(4096.0),
                "4096 ULPs",
            )
        },
        each(
            "asin",
            "asin(a)",
            UNIT.signed(),
            |a, _, _| a.asin(),
            Bound::Absolute(4096.0 * 2.0 * ROUNDING * 2.0),
            "that of atan(a, sqrt(1 - a * a))",
        ),
        Operation {
            spans: [SMALL, SMALL, UNIT],
            ..whole(
                ("mix", "mix(a, b, c)"),
                SMALL,
                |[a, b, c]| std::array::from_fn(|i| a[i] * (1.0 - c[i]) + b[i] * c[i]),
                (4.0, |[a, b, c]| std::array::from_fn(|i| (a[i] * (1.0 - c[i])).abs() + (b[i] * c[i]).abs())),
                "that of a * (1 - c) + b * c",
            )
        },
        whole(
            ("dot", "vec4(dot(a, b), dot(a.xyz, b.xyz), dot(a.xy, b.xy), dot(a.yz, b.zw))"),
            SMALL,
            |[a, b, _]| [dot(a, b), dot(&a[..3], &b[..3]), dot(&a[..2], &b[..2]), dot(&a[1..3], &b[2..])],
            (5.0, |[a, b, _]| [size(a, b), size(&a[..3], &b[..3]), size(&a[..2], &b[..2]), size(&a[1..3], &b[2..])]),
            "that of the sum of products",
        ),
        whole(
            ("length", "vec4(length(a), length(a.xyz), length(a.xy), distance(a, b))"),
            Span::new(-3, 3).signed(),
            |[a, b, _]| {
                let difference: Vector = std::array::from_fn(|i| a[i] - b[i]);
                [dot(a, a), dot(&a[..3], &a[..3]), dot(&a[..2], &a[..2]), dot(&difference, &difference)].map(f64::sqrt)
            },
            (10.0, |[a, b, _]| {
                let sum: Vector = std::array::from_fn(|i| a[i].abs() + b[i].abs());
                [size(a, a), size(&a[..3], &a[..3]), size(&a[..2], &a[..2]), size(&sum, &sum)].map(f64::sqrt)
            }),
            "that of sqrt(dot(a, a))",
        ),
        whole(
            ("normalize", "vec4(normalize(a.xyz), normalize(b.xy).y)"),
            Span::new(-3, 3).signed(),
            |[a, b, _]| {
                let (long, short) = (dot(&a[..3], &a[..3]).sqrt(), dot(&b[..2], &b[..2]).sqrt());
                [a[0] / long, a[1] / long, a[2] / long, b[1] / short]
            },
            (16.0, |_| [1.0; 4]),
            "that of a / length(a)",
        ),
        whole(
            ("cross", "vec4(cross(a.xyz, b.xyz), 0)"),
            SMALL,
            |[a, b, _]| cross(a, b, |x, y| x - y),
            (3.0, |[a, b, _]| cross(a, b, |x, y| x.abs() + y.abs())),
            "that of the difference of products",
        ),
        whole(
            ("mat2 * vec2", "vec4(mat2(a.xy, a.zw) * b.xy, b.xy * mat2(a.xz, a.yw))"),
            SMALL,
            |[a, b, _]| {
                let [x, y] = multiply(a, b, dot);
                [x, y, x, y]
            },
            (3.0, |[a, b, _]| {
                let [x, y] = multiply(a, b, size);
                [x, y, x, y]
            }),
            "that of the sums of products",
        ),
        whole(
            (
                "mat2 * mat2",
                "(mat2(a.xy, a.zw) * mat2(b.xy, b.zw))[0].xyxy + (mat2(a.xy, a.zw) * mat2(b.xy, b.zw))[1].xyxy",
            ),
            SMALL,
            |[a, b, _]| {
                let ([x, y], [z, w]) = (multiply(a, &b[..2], dot), multiply(a, &b[2..], dot));
                [x + z, y + w, x + z, y + w]
            },
            (5.0, |[a, b, _]| {
                let ([x, y], [z, w]) = (multiply(a, &b[..2], size), multiply(a, &b[2..], size));
                [x + z, y + w, x + z, y + w]
            }),
            "that of the sums of products",
        ),
    ];
    for operation in &mut operations {
        let nearer = LAVAPIPE.iter().find(|(name, _)| *name == operation.name);
        operation.lavapipe = nearer.map_or(operation.lavapipe, |(_, bound)| *bound);
    }
    operations
}

/// Vulkan's bound for `sin` and `cos`.
pub(super) const SINE: f64 = 1.0 / 2048.0;

/// The operations for which lavapipe was found to have a smaller error; bounds are about twice the measured errors;
/// `log2` takes up to 2.7 of the 3 ULPs.
const LAVAPIPE: &[(&str, Bound)] = &[
    ("sqrt", Bound::Rounded),
    ("exp2", Bound::Ulps(6.0)),
    ("log2", Bound::Ulps(3.0)),
    ("log2 near 1", Bound::Absolute(3e-7)),
    ("log", Bound::Ulps(3.0)),
    ("sin", Bound::Ulps(2.0)),
    ("cos", Bound::Ulps(2.0)),
    ("sin to 2^13", Bound::Absolute(2e-7)),
    ("cos to 2^13", Bound::Absolute(2e-7)),
    ("sin to 2^24", Bound::Absolute(3e-5)),
    ("tan", Bound::Ulps(3.0)),
    ("atan", Bound::Ulps(700.0)),
    ("atan of two", Bound::Ulps(700.0)),
];
