//! Functions of numbers, each component alone: sections 8.1 to 8.3.

use std::f32::consts::FRAC_PI_2;

use super::{
    constant::{
        self,
        Constant::{Each, Each2, Each3, Whole},
        extreme, test,
    },
    overloads::{patterns::*, sig},
    row::{Gap, Operation::*, ROW, Row, Test::Component, gap},
};
use crate::{
    ir::{Binary, Math},
    types::Scalar,
};

const LOGARITHM: &[Gap] =
    &[gap("the logarithm of 0 and below is undefined (8.2)", 0..1, Component(|[x, ..]| x <= 0.0))];

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    // 8.1 Angle and trigonometry.
    Row {
        name: "radians", params: "degrees", overloads: FLOAT, operation: Function(Math::Radians),
        constant: Each(|x| x * (std::f64::consts::PI / 180.0) as f32),
        text: "Degrees to radians: π / 180 · degrees.",
        ..ROW
    },
    Row {
        name: "degrees", params: "radians", overloads: FLOAT, operation: Function(Math::Degrees),
        constant: Each(|x| x * (180.0 / std::f64::consts::PI) as f32),
        text: "Radians to degrees: 180 / π · radians.",
        ..ROW
    },
    Row {
        name: "sin", params: "angle", overloads: FLOAT, operation: Function(Math::Sin), constant: Each(f32::sin),
        text: "Sine of an angle in radians, -1 to 1. Loses precision as the angle grows: keep it small with `mod`.",
        ..ROW
    },
    Row {
        name: "cos", params: "angle", overloads: FLOAT, operation: Function(Math::Cos), constant: Each(f32::cos),
        text: "Cosine of an angle in radians, -1 to 1. Loses precision as the angle grows: keep it small with `mod`.",
        ..ROW
    },
    Row {
        name: "tan", params: "angle", overloads: FLOAT, operation: Function(Math::Tan),
        constant: Each(|x| x.sin() / x.cos()),
        text: "Tangent of an angle in radians. Grows without bound near odd multiples of π/2.",
        ..ROW
    },
    Row {
        name: "asin", params: "x", overloads: FLOAT, operation: Function(Math::Asin),
        constant: Each(|x| constant::arc_sine(x, 0.086_566_724, -0.031_029_55)),
        gaps: &[gap("asin is undefined outside -1 to 1 (8.1)", 0..1, Component(|[x, ..]| x.abs() > 1.0))],
        text: "Angle in radians whose sine is x, -π/2 to π/2. Undefined where |x| > 1.",
        ..ROW
    },
    Row {
        name: "acos", params: "x", overloads: FLOAT, operation: Function(Math::Acos),
        constant: Each(|x| FRAC_PI_2 - constant::arc_sine(x, 0.081_324_63, -0.023_633_18)),
        gaps: &[gap("acos is undefined outside -1 to 1 (8.1)", 0..1, Component(|[x, ..]| x.abs() > 1.0))],
        text: "Angle in radians whose cosine is x, 0 to π. Undefined where |x| > 1: clamp what rounding may push \
               past 1.",
        ..ROW
    },
    Row {
        name: "atan", params: "y, x", overloads: &[sig(F, &[F, F]), sig(F, &[F])], operation: Atan,
        constant: Whole(constant::angle),
        gaps: &[gap("the angle of (0, 0) is undefined (8.1)", 0..2, Component(|[y, x, _]| y == 0.0 && x == 0.0))],
        text: "Angle in radians. `atan(y, x)`: of the point (x, y), -π to π, in the right quadrant; undefined where \
               both are 0. `atan(y_over_x)`: -π/2 to π/2.",
        ..ROW
    },
    Row {
        name: "sinh", params: "x", overloads: FLOAT, operation: Function(Math::Sinh),
        constant: Each(|x| 0.5 * (x.exp() - (-x).exp())),
        text: "Hyperbolic sine, (eˣ - e⁻ˣ) / 2. Overflows past |x| of about 88.",
        ..ROW
    },
    Row {
        name: "cosh", params: "x", overloads: FLOAT, operation: Function(Math::Cosh),
        constant: Each(|x| 0.5 * (x.exp() + (-x).exp())),
        text: "Hyperbolic cosine, (eˣ + e⁻ˣ) / 2, at least 1. Overflows past |x| of about 88.",
        ..ROW
    },
    Row {
        name: "tanh", params: "x", overloads: FLOAT, operation: Function(Math::Tanh),
        constant: Each(constant::hyperbolic_tangent),
        text: "Hyperbolic tangent, -1 to 1: a smooth step. Some drivers give NaN for |x| above 40; clamp x.",
        ..ROW
    },
    Row {
        name: "asinh", params: "x", overloads: FLOAT, operation: Function(Math::Asinh),
        constant: Each(|x| f64::from(x).asinh() as f32),
        text: "Inverse of `sinh`.",
        ..ROW
    },
    Row {
        name: "acosh", params: "x", overloads: FLOAT, operation: Function(Math::Acosh),
        constant: Each(|x| f64::from(x).acosh() as f32),
        gaps: &[gap("acosh is undefined below 1 (8.1)", 0..1, Component(|[x, ..]| x < 1.0))],
        text: "Inverse of `cosh`, the branch that is not negative. Undefined where x < 1.",
        ..ROW
    },
    Row {
        name: "atanh", params: "x", overloads: FLOAT, operation: Function(Math::Atanh),
        constant: Each(|x| f64::from(x).atanh() as f32),
        gaps: &[gap("atanh is undefined at and beyond -1 and 1 (8.1)", 0..1, Component(|[x, ..]| x.abs() >= 1.0))],
        text: "Inverse of `tanh`. Undefined where |x| ≥ 1.",
        ..ROW
    },
    // 8.2 Exponential.
    Row {
        name: "pow", params: "x, y", overloads: FLOATS, operation: Function(Math::Pow), constant: Each2(f32::powf),
        gaps: &[
            gap("pow of a negative base is undefined (8.2)", 0..2, Component(|[x, ..]| x < 0.0)),
            gap("pow of 0 is undefined unless the exponent is above 0 (8.2)", 0..2,
                Component(|[x, y, _]| x == 0.0 && y <= 0.0)),
        ],
        text: "x to the power of y. Undefined where x < 0, and where x = 0 and y ≤ 0. For small whole powers, \
               multiply.",
        ..ROW
    },
    Row {
        name: "exp", params: "x", overloads: FLOAT, operation: Function(Math::Exp), constant: Each(f32::exp),
        text: "e to the power of x.",
        ..ROW
    },
    Row {
        name: "log", params: "x", overloads: FLOAT, operation: Function(Math::Log), constant: Each(f32::ln),
        gaps: LOGARITHM,
        text: "Natural logarithm. Undefined where x ≤ 0.",
        ..ROW
    },
    Row {
        name: "exp2", params: "x", overloads: FLOAT, operation: Function(Math::Exp2), constant: Each(f32::exp2),
        text: "2 to the power of x.",
        ..ROW
    },
    Row {
        name: "log2", params: "x", overloads: FLOAT, operation: Function(Math::Log2), constant: Each(f32::log2),
        gaps: LOGARITHM,
        text: "Logarithm to base 2. Undefined where x ≤ 0.",
        ..ROW
    },
    Row {
        name: "sqrt", params: "x", overloads: FLOAT, operation: Function(Math::Sqrt), constant: Each(f32::sqrt),
        gaps: &[gap("the square root of a negative number is undefined (8.2)", 0..1, Component(|[x, ..]| x < 0.0))],
        text: "Square root. Undefined where x < 0.",
        ..ROW
    },
    Row {
        name: "inversesqrt", params: "x", overloads: FLOAT, operation: Function(Math::InverseSqrt),
        constant: Each(|x| 1.0 / x.sqrt()),
        gaps: &[gap("inversesqrt is undefined for 0 and below (8.2)", 0..1, Component(|[x, ..]| x <= 0.0))],
        text: "1 / sqrt(x). Undefined where x ≤ 0.",
        ..ROW
    },
    // 8.3 Common. Second and third arguments may be scalars where the first is a vector, as the overloads say.
    Row {
        name: "abs", params: "x", overloads: &[sig(F, &[F]), sig(I, &[I])], operation: Function(Math::Abs),
        constant: Whole(constant::absolute),
        text: "x without its sign. The most negative int stays as it is.",
        ..ROW
    },
    Row {
        name: "sign", params: "x", overloads: &[sig(F, &[F]), sig(I, &[I])], operation: Function(Math::Sign),
        constant: Whole(constant::sign),
        text: "-1, 0 or 1, as x is negative, zero or positive.",
        ..ROW
    },
    Row {
        name: "floor", params: "x", overloads: FLOAT, operation: Function(Math::Floor), constant: Each(f32::floor),
        text: "The largest whole number that is not above x, as a float.",
        ..ROW
    },
    Row {
        name: "trunc", params: "x", overloads: FLOAT, operation: Function(Math::Trunc), constant: Each(f32::trunc),
        text: "x rounded towards zero.",
        ..ROW
    },
    Row {
        name: "round", params: "x", overloads: FLOAT, operation: Function(Math::Round), constant: Each(f32::round),
        text: "The nearest whole number. Halves are rounded up or down, as the GPU prefers: use `roundEven` or \
               `floor(x + 0.5)` where it matters.",
        ..ROW
    },
    Row {
        name: "roundEven", params: "x", overloads: FLOAT, operation: Function(Math::Round),
        constant: Each(f32::round_ties_even),
        text: "The nearest whole number; halves are rounded to even: 2.5 and 1.5 both give 2.",
        ..ROW
    },
    Row {
        name: "ceil", params: "x", overloads: FLOAT, operation: Function(Math::Ceil), constant: Each(f32::ceil),
        text: "The smallest whole number that is not below x, as a float.",
        ..ROW
    },
    Row {
        name: "fract", params: "x", overloads: FLOAT, operation: Function(Math::Fract), constant: Each(|x| x - x.floor()),
        text: "x - floor(x): 0 to below 1, also for negative x. May round up to 1 just below a whole number.",
        ..ROW
    },
    Row {
        name: "mod", params: "x, y", overloads: &[sig(F, &[F, F]), sig(F, &[F, F1])], operation: Modulo,
        constant: Each2(|x, y| x - y * (x / y).floor()),
        text: "x - y · floor(x / y): has the sign of y, so patterns repeat evenly through zero. Undefined where y = \
               0.",
        ..ROW
    },
    Row {
        name: "modf", params: "x, i", overloads: FLOATS, operation: Modf, writes: Some(1),
        text: "The fraction of x, with x's sign; the whole part is written to i, as a float.",
        ..ROW
    },
    Row {
        name: "min", params: "x, y",
        overloads: &[
            sig(F, &[F, F]), sig(F, &[F, F1]), sig(I, &[I, I]), sig(I, &[I, I1]), sig(U, &[U, U]), sig(U, &[U, U1]),
        ],
        operation: Function(Math::Min), constant: Whole(|args, out| extreme(args, out, false)),
        text: "The smaller of the two, component by component. Either may come back where one is NaN.",
        ..ROW
    },
    Row {
        name: "max", params: "x, y",
        overloads: &[
            sig(F, &[F, F]), sig(F, &[F, F1]), sig(I, &[I, I]), sig(I, &[I, I1]), sig(U, &[U, U]), sig(U, &[U, U1]),
        ],
        operation: Function(Math::Max), constant: Whole(|args, out| extreme(args, out, true)),
        text: "The larger of the two, component by component. Either may come back where one is NaN.",
        ..ROW
    },
    Row {
        name: "clamp", params: "x, minVal, maxVal",
        overloads: &[
            sig(F, &[F, F, F]), sig(F, &[F, F1, F1]), sig(I, &[I, I, I]), sig(I, &[I, I1, I1]), sig(U, &[U, U, U]),
            sig(U, &[U, U1, U1]),
        ],
        operation: Function(Math::Clamp), constant: Whole(constant::clamped),
        gaps: &[
            gap("clamp is undefined where minVal is above maxVal (8.3)", 1..3, Component(|[_, low, high]| low > high)),
        ],
        text: "min(max(x, minVal), maxVal): x clamped to the range. Undefined where minVal > maxVal.",
        ..ROW
    },
    Row {
        name: "mix", params: "x, y, a", overloads: &[sig(F, &[F, F, F]), sig(F, &[F, F, F1]), sig(F, &[F, F, B])],
        operation: Mix, constant: Whole(constant::mixed), may_be_overloaded: true,
        text: "Linear blend x · (1 - a) + y · a; a is not clamped. With a bool: y where a is true, else x, with \
               nothing computed.",
        ..ROW
    },
    Row {
        name: "step", params: "edge, x", overloads: &[sig(F, &[F, F]), sig(F, &[F1, F])], operation: Step,
        constant: Each2(|edge, x| if x < edge { 0.0 } else { 1.0 }),
        text: "0 where x < edge, else 1.",
        ..ROW
    },
    Row {
        name: "smoothstep", params: "edge0, edge1, x", overloads: &[sig(F, &[F, F, F]), sig(F, &[F1, F1, F])],
        operation: Smoothstep, constant: Each3(constant::smooth_step),
        gaps: &[
            gap("smoothstep is undefined unless its first edge is below the second (8.3)", 0..2,
                Component(|[low, high, _]| low >= high)),
        ],
        text: "0 up to edge0, 1 from edge1, between them t · t · (3 - 2 · t). Undefined where edge0 ≥ edge1.",
        ..ROW
    },
    Row {
        name: "isnan", params: "x", overloads: &[sig(B, &[F])], operation: Exponent(Binary::Greater),
        constant: Whole(|args, out| test(args, out, f32::is_nan)),
        text: "Whether x is not a number. A device that has no NaNs may always say false.",
        ..ROW
    },
    Row {
        name: "isinf", params: "x", overloads: &[sig(B, &[F])], operation: Exponent(Binary::Equal),
        constant: Whole(|args, out| test(args, out, f32::is_infinite)),
        text: "Whether x is infinite, positive or negative.",
        ..ROW
    },
    Row {
        name: "floatBitsToInt", params: "value", overloads: &[sig(I, &[F])], operation: Bitcast(Scalar::Int),
        constant: Whole(|args, out| out.copy_from_slice(args[0].words)),
        text: "The 32 bits of a float as an int, unchanged: for hashing and for storing numbers in buffers.",
        ..ROW
    },
    Row {
        name: "floatBitsToUint", params: "value", overloads: &[sig(U, &[F])], operation: Bitcast(Scalar::Uint),
        constant: Whole(|args, out| out.copy_from_slice(args[0].words)),
        text: "The 32 bits of a float as a uint, unchanged: for hashing and for storing numbers in buffers.",
        ..ROW
    },
    Row {
        name: "intBitsToFloat", params: "value", overloads: &[sig(F, &[I])], operation: Bitcast(Scalar::Float),
        constant: Whole(|args, out| out.copy_from_slice(args[0].words)),
        text: "The float that has these 32 bits. Bits of a NaN need not survive.",
        ..ROW
    },
    Row {
        name: "uintBitsToFloat", params: "value", overloads: &[sig(F, &[U])], operation: Bitcast(Scalar::Float),
        constant: Whole(|args, out| out.copy_from_slice(args[0].words)),
        text: "The float that has these 32 bits. Bits of a NaN need not survive.",
        ..ROW
    },
];
