//! Values of built-in functions on constants (chapter 8), in 32-bit floats as a device computes them. Where a function
//! is undefined ANGLE gives zero, and so does this, with a warning.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use super::{checker::Checker, fault, words::Words};
use crate::{
    ast::Loc,
    hir::{Builtin as X, ExprId, Scalar, Type, TypeId},
};

/// An argument: its scalars, one of which may stand for all components.
#[derive(Clone, Copy)]
struct Arg<'w> {
    words: &'w [u32],
    scalar: Scalar,
    /// Columns and rows of a matrix, else one column.
    columns: usize,
}

impl Arg<'_> {
    fn bits(&self, i: usize) -> u32 {
        self.words[if self.words.len() == 1 { 0 } else { i }]
    }

    fn float(&self, i: usize) -> f32 {
        f32::from_bits(self.bits(i))
    }

    fn int(&self, i: usize) -> i32 {
        self.bits(i) as i32
    }

    fn floats(&self) -> impl Iterator<Item = f32> {
        self.words.iter().map(|&bits| f32::from_bits(bits))
    }
}

impl Checker<'_> {
    /// The value of a built-in whose arguments, on the stack above `base`, are all constants. `None` where it has none:
    /// it reads a texture, or writes an argument.
    pub(super) fn fold_builtin(&mut self, builtin: X, result: TypeId, base: usize, loc: Loc) -> Option<ExprId> {
        let nothing = Arg { words: &[], scalar: Scalar::Float, columns: 1 };
        let mut args = [nothing; 3];
        let given: &[ExprId] = &self.expr_stack[base..];
        if given.len() > args.len() {
            return None;
        }
        for (slot, &id) in args.iter_mut().zip(given) {
            let ty = self.module[id].ty;
            let columns = match self.module.types.get(ty) {
                Type::Matrix { columns, .. } => columns.into(),
                _ => 1,
            };
            *slot = Arg { words: self.words(id)?, scalar: self.module.types.scalar(ty)?, columns };
        }
        let count = self.module.types.components(result)? as usize;
        let mut undefined = false;
        let words = fold(builtin, &args[..given.len()], count, &mut undefined)?;
        let (mut is_nan, mut is_infinite) = (false, false);
        if self.module.types.scalar(result) == Some(Scalar::Float) && !fault::reads_bits(builtin) {
            let floats = args[..given.len()].iter().filter(|arg| arg.scalar == Scalar::Float);
            (is_nan, is_infinite) = fault::born(floats.map(|arg| arg.words), words.as_slice());
        }
        let id = self.constant(result, words.as_slice(), loc);
        if !undefined {
            self.note_floats(loc, is_nan, is_infinite);
        } else {
            self.undefined(loc, fault::domain(builtin));
            self.warning(loc, format!("`{}` is undefined for this value; 0 is used", builtin.name()));
        }
        Some(id)
    }
}

/// `count` is the number of components of the result.
fn fold(builtin: X, args: &[Arg<'_>], count: usize, undefined: &mut bool) -> Option<Words> {
    let a = *args.first()?;
    let b = args.get(1).copied().unwrap_or(a);
    let c = args.get(2).copied().unwrap_or(a);
    // The commonest shapes: floats in, floats out, component by component.
    let each =
        |f: &dyn Fn(f32) -> f32| -> Option<Words> { Some((0..count).map(|i| f(a.float(i)).to_bits()).collect()) };
    // In single precision, and what devices lack in the operations that OpenGL's compilers write out for it: so a
    // constant is the number that the device would compute.
    let wide = |f: fn(f64) -> f64| each(&|x| f(f64::from(x)) as f32);
    let each2 = |f: &dyn Fn(f32, f32) -> f32| -> Option<Words> {
        Some((0..count).map(|i| f(a.float(i), b.float(i)).to_bits()).collect())
    };
    let each3 = |f: &dyn Fn(f32, f32, f32) -> f32| -> Option<Words> {
        Some((0..count).map(|i| f(a.float(i), b.float(i), c.float(i)).to_bits()).collect())
    };
    let test = |f: &dyn Fn(usize) -> bool| -> Option<Words> { Some((0..count).map(|i| u32::from(f(i))).collect()) };
    let one = |x: f32| -> Option<Words> { Some([x.to_bits()].into_iter().collect()) };
    let mut outside = |bad: bool| {
        *undefined |= bad;
        bad
    };
    let any = |f: &dyn Fn(usize) -> bool| (0..count).any(f);
    match builtin {
        X::Radians => each(&|x| x * (std::f64::consts::PI / 180.0) as f32),
        X::Degrees => each(&|x| x * (180.0 / std::f64::consts::PI) as f32),
        X::Sin => each(&f32::sin),
        X::Cos => each(&f32::cos),
        X::Tan => each(&|x| x.sin() / x.cos()),
        X::Sinh => each(&|x| 0.5 * (x.exp() - (-x).exp())),
        X::Cosh => each(&|x| 0.5 * (x.exp() + (-x).exp())),
        X::Tanh => each(&|x| {
            let x = x.clamp(-10.0, 10.0);
            (x.exp() - (-x).exp()) / (x.exp() + (-x).exp())
        }),
        X::Asinh => wide(f64::asinh),
        X::Exp => each(&f32::exp),
        X::Exp2 => each(&f32::exp2),
        X::Asin => guarded(a, count, &mut outside, |x| x.abs() > 1.0, |x| arc_sine(x, 0.086_566_724, -0.031_029_55)),
        X::Acos => {
            let acos = |x| FRAC_PI_2 - arc_sine(x, 0.081_324_63, -0.023_633_18);
            guarded(a, count, &mut outside, |x| x.abs() > 1.0, acos)
        }
        X::Acosh => guarded(a, count, &mut outside, |x| x < 1.0, |x| f64::from(x).acosh() as f32),
        X::Atanh => guarded(a, count, &mut outside, |x| x.abs() >= 1.0, |x| f64::from(x).atanh() as f32),
        X::Log => guarded(a, count, &mut outside, |x| x <= 0.0, f32::ln),
        X::Log2 => guarded(a, count, &mut outside, |x| x <= 0.0, f32::log2),
        X::Sqrt => guarded(a, count, &mut outside, |x| x < 0.0, f32::sqrt),
        X::InverseSqrt => guarded(a, count, &mut outside, |x| x <= 0.0, |x| 1.0 / x.sqrt()),
        X::Atan if args.len() == 1 => each(&f32::atan),
        X::Atan => {
            outside(any(&|i| a.float(i) == 0.0 && b.float(i) == 0.0));
            each2(&f32::atan2)
        }
        X::Pow => {
            let bad = |x: f32, y: f32| x < 0.0 || (x == 0.0 && y <= 0.0);
            outside(any(&|i| bad(a.float(i), b.float(i))));
            each2(&|x, y| if bad(x, y) { 0.0 } else { x.powf(y) })
        }
        X::Abs if a.scalar == Scalar::Int => Some((0..count).map(|i| a.int(i).wrapping_abs() as u32).collect()),
        X::Abs => each(&f32::abs),
        X::Sign if a.scalar == Scalar::Int => Some((0..count).map(|i| a.int(i).signum() as u32).collect()),
        X::Sign => each(&|x| {
            if x > 0.0 {
                1.0
            } else if x < 0.0 {
                -1.0
            } else {
                0.0
            }
        }),
        X::Floor => each(&f32::floor),
        X::Trunc => each(&f32::trunc),
        X::Round => each(&f32::round),
        X::RoundEven => each(&f32::round_ties_even),
        X::Ceil => each(&f32::ceil),
        X::Fract => each(&|x| x - x.floor()),
        X::Mod => each2(&|x, y| x - y * (x / y).floor()),
        X::Min | X::Max => {
            let max = builtin == X::Max;
            Some((0..count).map(|i| extreme(a.scalar, a.bits(i), b.bits(i), max)).collect())
        }
        X::Clamp => {
            outside(any(&|i| extreme(a.scalar, b.bits(i), c.bits(i), false) != b.bits(i)));
            let low = |i: usize| extreme(a.scalar, a.bits(i), b.bits(i), true);
            Some((0..count).map(|i| extreme(a.scalar, low(i), c.bits(i), false)).collect())
        }
        X::Mix if c.scalar == Scalar::Bool => {
            Some((0..count).map(|i| if c.bits(i) != 0 { b.bits(i) } else { a.bits(i) }).collect())
        }
        X::Mix => each3(&|x, y, t| x * (1.0 - t) + y * t),
        X::Step => each2(&|edge, x| if x < edge { 0.0 } else { 1.0 }),
        X::Smoothstep => {
            outside(any(&|i| a.float(i) >= b.float(i)));
            each3(&|low, high, x| {
                if low >= high {
                    return 0.0;
                }
                let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
                t * (t * (3.0 - 2.0 * t))
            })
        }
        X::IsNan => test(&|i| a.float(i).is_nan()),
        X::IsInf => test(&|i| a.float(i).is_infinite()),
        X::FloatBitsToInt | X::FloatBitsToUint | X::IntBitsToFloat | X::UintBitsToFloat => {
            Some(a.words.iter().copied().collect())
        }
        X::PackSnorm2x16 => pack(a, |x| (x.clamp(-1.0, 1.0) * 32767.0).round_ties_even() as i32 as u32 & 0xFFFF),
        X::PackUnorm2x16 => pack(a, |x| (x.clamp(0.0, 1.0) * 65535.0).round_ties_even() as u32),
        X::PackHalf2x16 => pack(a, half_bits),
        X::UnpackSnorm2x16 => unpack(a, |bits| (f32::from(bits as i16) / 32767.0).clamp(-1.0, 1.0)),
        X::UnpackUnorm2x16 => unpack(a, |bits| f32::from(bits) / 65535.0),
        X::UnpackHalf2x16 => unpack(a, half_value),
        X::Length => one(length(a.floats())),
        X::Distance => one(length(a.floats().zip(b.floats()).map(|(x, y)| x - y))),
        X::Dot => one(dot(a, b)),
        X::Cross => {
            let minor = |i: usize, j: usize| a.float(i) * b.float(j) - b.float(i) * a.float(j);
            Some([minor(1, 2), minor(2, 0), minor(0, 1)].into_iter().map(f32::to_bits).collect())
        }
        X::Normalize => {
            let length = length(a.floats());
            let zero = outside(length == 0.0);
            let scale = 1.0 / length;
            each(&|x| if zero { 0.0 } else { x * scale })
        }
        X::FaceForward => {
            let flip = dot(c, b) >= 0.0;
            each(&|x| if flip { -x } else { x })
        }
        X::Reflect => {
            let twice = 2.0 * dot(b, a);
            each2(&|i, n| i - twice * n)
        }
        X::Refract => {
            let (eta, along) = (c.float(0), dot(b, a));
            let k = 1.0 - eta * eta * (1.0 - along * along);
            each2(&|i, n| if k < 0.0 { 0.0 } else { eta * i - (eta * along + k.sqrt()) * n })
        }
        X::MatrixCompMult => each2(&|x, y| x * y),
        X::OuterProduct => {
            let rows = a.words.len();
            Some((0..count).map(|i| (a.float(i % rows) * b.float(i / rows)).to_bits()).collect())
        }
        X::Transpose => {
            let (columns, rows) = (a.columns, a.words.len() / a.columns);
            Some((0..count).map(|i| a.words[(i % columns) * rows + i / columns]).collect())
        }
        X::Determinant => one(determinant(&square(a), a.columns) as f32),
        X::Inverse => {
            let inverse = inverse(&square(a), a.columns);
            outside(inverse.is_none());
            Some((0..count).map(|i| inverse.map_or(0.0, |m| m[i] as f32).to_bits()).collect())
        }
        X::LessThan | X::LessThanEqual | X::GreaterThan | X::GreaterThanEqual | X::Equal | X::NotEqual => {
            test(&|i| compare(builtin, a.scalar, a.bits(i), b.bits(i)))
        }
        X::Any => Some([u32::from(a.words.contains(&1))].into_iter().collect()),
        X::All => Some([u32::from(!a.words.contains(&0))].into_iter().collect()),
        X::Not => test(&|i| a.bits(i) == 0),
        X::DFdx | X::DFdy | X::Fwidth => each(&|_| 0.0),
        X::Modf
        | X::StAssert
        | X::TextureSize
        | X::Texture
        | X::TextureProj
        | X::TextureLod
        | X::TextureOffset
        | X::TexelFetch
        | X::TexelFetchOffset
        | X::TextureProjOffset
        | X::TextureLodOffset
        | X::TextureProjLod
        | X::TextureProjLodOffset
        | X::TextureGrad
        | X::TextureGradOffset
        | X::TextureProjGrad
        | X::TextureProjGradOffset => None,
    }
}

/// A function with a domain: zero outside, and that is noted.
fn guarded(
    a: Arg<'_>,
    count: usize,
    outside: &mut impl FnMut(bool) -> bool,
    bad: fn(f32) -> bool,
    f: fn(f32) -> f32,
) -> Option<Words> {
    let value = |x: f32, bad: bool| if bad { 0.0 } else { f(x) };
    Some((0..count).map(|i| value(a.float(i), outside(bad(a.float(i)))).to_bits()).collect())
}

fn extreme(scalar: Scalar, a: u32, b: u32, max: bool) -> u32 {
    let b_is_less = match scalar {
        Scalar::Float => f32::from_bits(b) < f32::from_bits(a),
        Scalar::Int => (b as i32) < a as i32,
        Scalar::Uint | Scalar::Bool => b < a,
    };
    let b_is_greater = match scalar {
        Scalar::Float => f32::from_bits(a) < f32::from_bits(b),
        Scalar::Int => (a as i32) < b as i32,
        Scalar::Uint | Scalar::Bool => a < b,
    };
    if if max { b_is_greater } else { b_is_less } { b } else { a }
}

fn compare(builtin: X, scalar: Scalar, a: u32, b: u32) -> bool {
    let order = match scalar {
        Scalar::Float => f32::from_bits(a).partial_cmp(&f32::from_bits(b)),
        Scalar::Int => Some((a as i32).cmp(&(b as i32))),
        Scalar::Uint | Scalar::Bool => Some(a.cmp(&b)),
    };
    // No order, as with a NaN, makes everything false but inequality.
    match builtin {
        X::LessThan => order.is_some_and(|o| o.is_lt()),
        X::LessThanEqual => order.is_some_and(|o| o.is_le()),
        X::GreaterThan => order.is_some_and(|o| o.is_gt()),
        X::GreaterThanEqual => order.is_some_and(|o| o.is_ge()),
        X::Equal => order.is_some_and(|o| o.is_eq()),
        _ => !order.is_some_and(|o| o.is_eq()),
    }
}

fn dot(a: Arg<'_>, b: Arg<'_>) -> f32 {
    a.floats().zip(b.floats()).map(|(x, y)| x * y).reduce(|sum, term| sum + term).unwrap_or(0.0)
}

/// The polynomial of OpenGL's compilers, right to 0.0002.
fn arc_sine(x: f32, cubic: f32, quartic: f32) -> f32 {
    let size = x.abs();
    let sum = FRAC_PI_2 + size * ((FRAC_PI_4 - 1.0) + size * (cubic + size * quartic));
    let sign = if x == 0.0 { 0.0 } else { x.signum() };
    sign * (FRAC_PI_2 - (1.0 - size).sqrt() * sum)
}

fn length(floats: impl Iterator<Item = f32>) -> f32 {
    floats.map(|x| x * x).reduce(|sum, term| sum + term).unwrap_or(0.0).sqrt()
}

fn pack(a: Arg<'_>, f: impl Fn(f32) -> u32) -> Option<Words> {
    Some([f(a.float(0)) | f(a.float(1)) << 16].into_iter().collect())
}

fn unpack(a: Arg<'_>, f: impl Fn(u16) -> f32) -> Option<Words> {
    let bits = a.bits(0);
    Some([f(bits as u16), f((bits >> 16) as u16)].into_iter().map(f32::to_bits).collect())
}

/// A float as 16 bits, rounded to nearest even; too large is infinity.
fn half_bits(x: f32) -> u32 {
    let bits = x.to_bits();
    let sign = bits >> 16 & 0x8000;
    let magnitude = bits & 0x7FFF_FFFF;
    if magnitude > 0x7F80_0000 {
        return sign | 0x7E00;
    }
    // Halfway between the greatest half, 65504, and what would be the next.
    if magnitude >= 0x477F_F000 {
        return sign | 0x7C00;
    }
    if magnitude < 0x3880_0000 {
        // Subnormal: so many steps of 2^-24.
        let steps = f64::from(f32::from_bits(magnitude)) * f64::from(1 << 24);
        return sign | steps.round_ties_even() as u32;
    }
    let rebiased = magnitude - (112 << 23);
    let rounded = rebiased + 0xFFF + (rebiased >> 13 & 1);
    sign | rounded >> 13
}

fn half_value(bits: u16) -> f32 {
    let sign = if bits & 0x8000 != 0 { -1.0 } else { 1.0 };
    let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f32::from(bits & 0x3FF));
    sign * match exponent {
        0 => mantissa * 2f32.powi(-24),
        31 if mantissa != 0.0 => f32::NAN,
        31 => f32::INFINITY,
        _ => (1.0 + mantissa / 1024.0) * 2f32.powi(exponent - 15),
    }
}

/// A square matrix in 64 bits, column-major.
fn square(a: Arg<'_>) -> [f64; 16] {
    let mut out = [0.0; 16];
    for (slot, value) in out.iter_mut().zip(a.floats()) {
        *slot = value.into();
    }
    out
}

fn determinant(m: &[f64; 16], n: usize) -> f64 {
    if n == 1 {
        return m[0];
    }
    (0..n).map(|column| m[column * n] * cofactor(m, n, column, 0)).sum()
}

/// The signed determinant of what is left without a column and a row.
fn cofactor(m: &[f64; 16], n: usize, column: usize, row: usize) -> f64 {
    let mut minor = [0.0; 16];
    let mut at = 0;
    for c in (0..n).filter(|&c| c != column) {
        for r in (0..n).filter(|&r| r != row) {
            minor[at] = m[c * n + r];
            at += 1;
        }
    }
    let sign = if (column + row).is_multiple_of(2) { 1.0 } else { -1.0 };
    sign * determinant(&minor, n - 1)
}

fn inverse(m: &[f64; 16], n: usize) -> Option<[f64; 16]> {
    let determinant = determinant(m, n);
    if determinant == 0.0 {
        return None;
    }
    let mut out = [0.0; 16];
    for column in 0..n {
        for row in 0..n {
            out[column * n + row] = cofactor(m, n, row, column) / determinant;
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floats(values: &[f32]) -> Vec<u32> {
        values.iter().map(|v| v.to_bits()).collect()
    }

    fn call(builtin: X, args: &[(&[f32], usize)], count: usize) -> Vec<f32> {
        let words: Vec<Vec<u32>> = args.iter().map(|(values, _)| floats(values)).collect();
        let args: Vec<Arg<'_>> = words
            .iter()
            .zip(args)
            .map(|(words, &(_, columns))| Arg { words, scalar: Scalar::Float, columns })
            .collect();
        let folded = fold(builtin, &args, count, &mut false).unwrap();
        folded.as_slice().iter().map(|&bits| f32::from_bits(bits)).collect()
    }

    #[test]
    fn scalars_stand_for_all_components() {
        assert_eq!(call(X::Max, &[(&[1., -2., 3.], 1), (&[0.], 1)], 3), [1., 0., 3.]);
        assert_eq!(call(X::Mod, &[(&[-1., 5.5], 1), (&[3.], 1)], 2), [2., 2.5]);
        assert_eq!(call(X::Mix, &[(&[0., 10.], 1), (&[1., 20.], 1), (&[0.5], 1)], 2), [0.5, 15.]);
        assert_eq!(call(X::Smoothstep, &[(&[0.], 1), (&[1.], 1), (&[0.5, 2.], 1)], 2), [0.5, 1.]);
    }

    /// The last bits are those of the operations in which OpenGL's compilers write these functions out.
    #[test]
    fn last_bits() {
        assert_eq!(call(X::Normalize, &[(&[0.2, 0., -1.], 1)], 3)[0].to_bits(), 0x3e48_d2ab);
        assert_eq!(call(X::Acos, &[(&[-0.447_213_6], 1)], 1), [2.034_546]);
        assert_eq!(call(X::Acos, &[(&[-1., 0., 1.], 1)], 3), [2. * FRAC_PI_2, FRAC_PI_2, 0.]);
        assert_eq!(call(X::Asin, &[(&[-1., 0., 1.], 1)], 3), [-FRAC_PI_2, 0., FRAC_PI_2]);
        assert_eq!(call(X::Asin, &[(&[0.3], 1)], 1), [0.304_620_98]);
        assert_eq!(call(X::Tanh, &[(&[-20., 0., 20.], 1)], 3), [-1., 0., 1.]);
    }

    #[test]
    fn matrices() {
        // Two columns of three rows become three columns of two rows.
        assert_eq!(call(X::Transpose, &[(&[1., 2., 3., 4., 5., 6.], 2)], 6), [1., 4., 2., 5., 3., 6.]);
        assert_eq!(call(X::OuterProduct, &[(&[1., 2., 3.], 1), (&[10., 20.], 1)], 6), [10., 20., 30., 20., 40., 60.]);
        assert_eq!(call(X::Determinant, &[(&[2., 1., 5., 3.], 2)], 1), [1.]);
        assert_eq!(call(X::Inverse, &[(&[2., 1., 5., 3.], 2)], 4), [3., -1., -5., 2.]);
        let m = [2., 0., 0., 0., 0., 4., 0., 0., 0., 0., 8., 0., 1., 2., 3., 1.];
        let inverse = call(X::Inverse, &[(&m, 4)], 16);
        assert_eq!(inverse[12..], [-0.5, -0.5, -0.375, 1.]);
    }

    #[test]
    fn halves_round_to_even_and_come_back() {
        for (x, bits) in
            [(1.0, 0x3C00), (-2.0, 0xC000), (65504.0, 0x7BFF), (65520.0, 0x7C00), (5.96e-8, 1), (0.1, 0x2E66)]
        {
            assert_eq!(half_bits(x), bits, "{x}");
        }
        assert_eq!(half_value(0x2E66), 0.099_975_586);
        assert_eq!(half_value(0x0001), 2f32.powi(-24));
        assert!(half_value(0x7E01).is_nan());
        assert_eq!(half_bits(f32::NEG_INFINITY), 0xFC00);
    }

    #[test]
    fn outside_its_domain_a_function_is_zero_and_noted() {
        let mut undefined = false;
        let words = floats(&[-1.0, 4.0]);
        let arg = Arg { words: &words, scalar: Scalar::Float, columns: 1 };
        let folded = fold(X::Sqrt, &[arg], 2, &mut undefined).unwrap();
        assert_eq!(folded.as_slice(), floats(&[0.0, 2.0]));
        assert!(undefined);
    }
}
