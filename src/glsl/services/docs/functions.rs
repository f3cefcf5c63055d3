//! Says what the functions of chapter 8 of GLSL ES 3.00 do, all but those that read textures.

use super::built_in::Function;
use crate::hir::Builtin;

/// Names of the parameters and what the function does.
#[rustfmt::skip]
pub(super) fn of(builtin: Builtin) -> Function {
    use Builtin as B;
    let (params, text) = match builtin {
        // 8.1 Angle and trigonometry.
        B::Radians => ("degrees", "Degrees to radians: π / 180 · degrees."),
        B::Degrees => ("radians", "Radians to degrees: 180 / π · radians."),
        B::Sin => ("angle", "Sine of an angle in radians, -1 to 1. Loses precision as the angle grows: keep it \
                             small with `mod`."),
        B::Cos => ("angle", "Cosine of an angle in radians, -1 to 1. Loses precision as the angle grows: keep it \
                             small with `mod`."),
        B::Tan => ("angle", "Tangent of an angle in radians. Grows without bound near odd multiples of π/2."),
        B::Asin => ("x", "Angle in radians whose sine is x, -π/2 to π/2. Undefined where |x| > 1."),
        B::Acos => ("x", "Angle in radians whose cosine is x, 0 to π. Undefined where |x| > 1: clamp what rounding may \
                          push past 1."),
        B::Atan => ("y, x", "Angle in radians. `atan(y, x)`: of the point (x, y), -π to π, in the right quadrant; \
                             undefined where both are 0. `atan(y_over_x)`: -π/2 to π/2."),
        B::Sinh => ("x", "Hyperbolic sine, (eˣ - e⁻ˣ) / 2. Overflows past |x| of about 88."),
        B::Cosh => ("x", "Hyperbolic cosine, (eˣ + e⁻ˣ) / 2, at least 1. Overflows past |x| of about 88."),
        B::Tanh => ("x", "Hyperbolic tangent, -1 to 1: a smooth step. Some drivers give NaN for |x| above 40; clamp \
                          x."),
        B::Asinh => ("x", "Inverse of `sinh`."),
        B::Acosh => ("x", "Inverse of `cosh`, the branch that is not negative. Undefined where x < 1."),
        B::Atanh => ("x", "Inverse of `tanh`. Undefined where |x| ≥ 1."),
        // 8.2 Exponential.
        B::Pow => ("x, y", "x to the power of y. Undefined where x < 0, and where x = 0 and y ≤ 0. For small whole \
                            powers, multiply."),
        B::Exp => ("x", "e to the power of x."),
        B::Log => ("x", "Natural logarithm. Undefined where x ≤ 0."),
        B::Exp2 => ("x", "2 to the power of x."),
        B::Log2 => ("x", "Logarithm to base 2. Undefined where x ≤ 0."),
        B::Sqrt => ("x", "Square root. Undefined where x < 0."),
        B::InverseSqrt => ("x", "1 / sqrt(x). Undefined where x ≤ 0."),
        // 8.3 Common.
        B::Abs => ("x", "x without its sign. The most negative int stays as it is."),
        B::Sign => ("x", "-1, 0 or 1, as x is negative, zero or positive."),
        B::Floor => ("x", "The largest whole number that is not above x, as a float."),
        B::Trunc => ("x", "x rounded towards zero."),
        B::Round => ("x", "The nearest whole number. Halves are rounded up or down, as the GPU prefers: use \
                           `roundEven` or `floor(x + 0.5)` where it matters."),
        B::RoundEven => ("x", "The nearest whole number; halves are rounded to even: 2.5 and 1.5 both give 2."),
        B::Ceil => ("x", "The smallest whole number that is not below x, as a float."),
        B::Fract => ("x", "x - floor(x): 0 to below 1, also for negative x. May round up to 1 just below a whole \
                           number."),
        B::Mod => ("x, y", "x - y · floor(x / y): has the sign of y, so patterns repeat evenly through zero. \
                            Undefined where y = 0."),
        B::Modf => ("x, i", "The fraction of x, with x's sign; the whole part is written to i, as a float."),
        B::Min => ("x, y", "The smaller of the two, component by component. Either may come back where one is NaN."),
        B::Max => ("x, y", "The larger of the two, component by component. Either may come back where one is NaN."),
        B::Clamp => ("x, minVal, maxVal", "min(max(x, minVal), maxVal): x clamped to the range. Undefined where minVal > maxVal."),
        B::Mix => ("x, y, a", "Linear blend x · (1 - a) + y · a; a is not clamped. With a bool: y where a is true, \
                               else x, with nothing computed."),
        B::Step => ("edge, x", "0 where x < edge, else 1."),
        B::Smoothstep => ("edge0, edge1, x", "0 up to edge0, 1 from edge1, between them t · t · (3 - 2 · t). Undefined \
                                              where edge0 ≥ edge1."),
        B::IsNan => ("x", "Whether x is not a number. A device that has no NaNs may always say false."),
        B::IsInf => ("x", "Whether x is infinite, positive or negative."),
        B::FloatBitsToInt => ("value", "The 32 bits of a float as an int, unchanged: for hashing and for storing \
                                        numbers in buffers."),
        B::FloatBitsToUint => ("value", "The 32 bits of a float as a uint, unchanged: for hashing and for storing \
                                         numbers in buffers."),
        B::IntBitsToFloat => ("value", "The float that has these 32 bits. Bits of a NaN need not survive."),
        B::UintBitsToFloat => ("value", "The float that has these 32 bits. Bits of a NaN need not survive."),
        // 8.4 Packing.
        B::PackSnorm2x16 => ("v", "Two floats, clamped to -1..1, as 16-bit integers in one uint: round(v · 32767). v.x \
                                   takes the low bits."),
        B::UnpackSnorm2x16 => ("p", "The two numbers in -1..1 that `packSnorm2x16` stored; x from the low bits."),
        B::PackUnorm2x16 => ("v", "Two floats, clamped to 0..1, as 16-bit integers in one uint: round(v · 65535). v.x \
                                   takes the low bits."),
        B::UnpackUnorm2x16 => ("p", "The two numbers in 0..1 that `packUnorm2x16` stored; x from the low bits."),
        B::PackHalf2x16 => ("v", "Two floats as 16-bit floats in one uint: 11 bits of precision, up to 65504. v.x \
                                  takes the low bits."),
        B::UnpackHalf2x16 => ("p", "The two floats that `packHalf2x16` stored; x from the low bits."),
        // 8.5 Geometry.
        B::Length => ("x", "Length of a vector, sqrt(dot(x, x)); for a float its absolute value."),
        B::Distance => ("p0, p1", "Distance of two points, length(p0 - p1)."),
        B::Dot => ("x, y", "Sum of the products of components: |x| · |y| · cos of the angle between them."),
        B::Cross => ("x, y", "A vector perpendicular to both (right-hand rule); its length is the area of the \
                              parallelogram they span."),
        B::Normalize => ("x", "The vector of length 1 in the direction of x. Undefined for a vector of length 0."),
        B::FaceForward => ("N, I, Nref", "N where dot(Nref, I) < 0, else -N: a normal turned against the ray I."),
        B::Reflect => ("I, N", "The ray I reflected by a surface of normal N: I - 2 · dot(N, I) · N. N must have \
                                length 1."),
        B::Refract => ("I, N, eta", "The ray I refracted at a surface of normal N; eta is the ratio of the indices, \
                                     from / into. The zero vector where all is reflected. I and N must have length 1."),
        // 8.6 Matrices.
        B::MatrixCompMult => ("x, y", "Product component by component. The product of linear algebra is `x * y`."),
        B::OuterProduct => ("c, r", "The matrix c · rᵀ: as many rows as c and as many columns as r have components."),
        B::Transpose => ("m", "The matrix with rows and columns exchanged."),
        B::Determinant => ("m", "Determinant of a square matrix: the signed volume its columns span; 0 where it has no \
                                 inverse."),
        B::Inverse => ("m", "Inverse of a square matrix. Undefined where the determinant is 0 or nearly so."),
        // 8.7 Vector relations.
        B::LessThan => ("x, y", "x < y, component by component, as a vector of bools."),
        B::LessThanEqual => ("x, y", "x <= y, component by component, as a vector of bools."),
        B::GreaterThan => ("x, y", "x > y, component by component, as a vector of bools."),
        B::GreaterThanEqual => ("x, y", "x >= y, component by component, as a vector of bools."),
        B::Equal => ("x, y", "x == y, component by component, as a vector of bools. The operator `==` gives one bool \
                              for all."),
        B::NotEqual => ("x, y", "x != y, component by component, as a vector of bools. The operator `!=` gives one \
                                 bool for all."),
        B::Any => ("x", "True if any component is true."),
        B::All => ("x", "True if all components are true."),
        B::Not => ("x", "Each component negated. For a single bool write `!x`."),
        // 8.9 Derivatives.
        B::DFdx => ("p", "How much p changes from this pixel to its neighbour on the right, by differences within \
                          2x2 pixels. Undefined in branches and loops that not all four pixels share."),
        B::DFdy => ("p", "How much p changes from this pixel to its neighbour above, by differences within 2x2 \
                          pixels. Undefined in branches and loops that not all four pixels share."),
        B::Fwidth => ("p", "abs(dFdx(p)) + abs(dFdy(p)): about how much p changes over one pixel; the width of a \
                            smooth edge."),
        B::StAssert => ("condition, value", "Shadertoy only, in Image: paints the picture if the condition is \
                                             false: red, or red, green, blue or yellow for value 0 to 3."),
        _ => return super::textures::of(builtin),
    };
    Function { params, text }
}
