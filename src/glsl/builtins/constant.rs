//! Constant folding of built-in functions (chapter 8), in 32-bit floats as a device computes them. Where a function is
//! undefined the value is zero, as in ANGLE, except for `atan` and `clamp`.

use std::{
    cmp::Ordering,
    f32::consts::{FRAC_PI_2, FRAC_PI_4},
};

use super::row::Row;
use crate::{ir::Binary, types::Scalar};

/// The evaluation of a function on constants.
#[derive(Debug)]
pub enum Constant {
    /// Not evaluated: it reads a texture, or has an effect.
    None,
    /// Floats to floats, component by component, and zero in the function's gaps.
    Each(fn(f32) -> f32),
    Each2(fn(f32, f32) -> f32),
    Each3(fn(f32, f32, f32) -> f32),
    /// Computes the scalars of the result, which fill the output slice, from those of the arguments.
    Whole(fn(&[Arg<'_>], &mut [u32])),
}

/// A constant argument: its scalars. A single one is broadcast to all components.
#[derive(Clone, Copy, Debug)]
pub struct Arg<'w> {
    pub words: &'w [u32],
    pub scalar: Scalar,
    /// Columns of a matrix, otherwise 1.
    pub columns: usize,
}

impl Arg<'_> {
    pub(super) fn bits(&self, i: usize) -> u32 {
        self.words[if self.words.len() == 1 { 0 } else { i }]
    }

    pub(super) fn float(&self, i: usize) -> f32 {
        f32::from_bits(self.bits(i))
    }

    /// Returns a component as a number of its type.
    pub fn number(&self, i: usize) -> f64 {
        match self.scalar {
            Scalar::Float => self.float(i).into(),
            Scalar::Int => (self.bits(i) as i32).into(),
            Scalar::Uint | Scalar::Bool => self.bits(i).into(),
        }
    }

    /// Returns a component as GLSL writes it.
    pub fn text(&self, i: usize) -> String {
        match self.scalar {
            Scalar::Float => format!("{:?}", self.float(i)),
            Scalar::Int => (self.bits(i) as i32).to_string(),
            Scalar::Uint | Scalar::Bool => self.bits(i).to_string(),
        }
    }

    pub(super) fn floats(&self) -> impl Iterator<Item = f32> {
        self.words.iter().map(|&bits| f32::from_bits(bits))
    }
}

impl Row {
    /// Computes the scalars of the value on constants; returns whether the function has one.
    pub fn fold(&self, args: &[Arg<'_>], out: &mut [u32]) -> bool {
        let mut each = |f: &dyn Fn(usize) -> f32| {
            for (i, word) in out.iter_mut().enumerate() {
                let is_in_gap = self.undefined_for.iter().any(|gap| gap.holds(args, i));
                *word = if is_in_gap { 0 } else { f(i).to_bits() };
            }
        };
        match self.constant {
            Constant::None => return false,
            Constant::Each(f) => each(&|i| f(args[0].float(i))),
            Constant::Each2(f) => each(&|i| f(args[0].float(i), args[1].float(i))),
            Constant::Each3(f) => each(&|i| f(args[0].float(i), args[1].float(i), args[2].float(i))),
            Constant::Whole(f) => f(args, out),
        }
        true
    }
}

/// Sets each component of the result.
pub(super) fn fill(out: &mut [u32], f: impl Fn(usize) -> u32) {
    out.iter_mut().enumerate().for_each(|(i, word)| *word = f(i));
}

/// As [`fill`], with floats.
pub(super) fn fill_floats(out: &mut [u32], f: impl Fn(usize) -> f32) {
    fill(out, |i| f(i).to_bits());
}

pub(super) fn test(args: &[Arg<'_>], out: &mut [u32], f: fn(f32) -> bool) {
    fill(out, |i| f(args[0].float(i)).into());
}

pub(super) fn negated(args: &[Arg<'_>], out: &mut [u32]) {
    fill(out, |i| u32::from(args[0].bits(i) == 0));
}

pub(super) fn hyperbolic_tangent(x: f32) -> f32 {
    let x = x.clamp(-10.0, 10.0);
    (x.exp() - (-x).exp()) / (x.exp() + (-x).exp())
}

/// The polynomial that OpenGL's compilers use, accurate to 0.0002.
pub(super) fn arc_sine(x: f32, cubic: f32, quartic: f32) -> f32 {
    let size = x.abs();
    let sum = FRAC_PI_2 + size * ((FRAC_PI_4 - 1.0) + size * (cubic + size * quartic));
    let sign = if x == 0.0 { 0.0 } else { x.signum() };
    sign * (FRAC_PI_2 - (1.0 - size).sqrt() * sum)
}

pub(super) fn angle(args: &[Arg<'_>], out: &mut [u32]) {
    fill_floats(out, |i| match args {
        [y, x] => y.float(i).atan2(x.float(i)),
        _ => args[0].float(i).atan(),
    });
}

pub(super) fn absolute(args: &[Arg<'_>], out: &mut [u32]) {
    let x = args[0];
    match x.scalar {
        Scalar::Int => fill(out, |i| (x.bits(i) as i32).wrapping_abs() as u32),
        _ => fill_floats(out, |i| x.float(i).abs()),
    }
}

pub(super) fn sign(args: &[Arg<'_>], out: &mut [u32]) {
    let sign = |x: f32| f32::from(i8::from(x > 0.0) - i8::from(x < 0.0));
    match args[0].scalar {
        Scalar::Int => fill(out, |i| (args[0].bits(i) as i32).signum() as u32),
        _ => fill_floats(out, |i| sign(args[0].float(i))),
    }
}

/// Returns the order of two scalars; `None` with a NaN.
fn order(scalar: Scalar, a: u32, b: u32) -> Option<Ordering> {
    match scalar {
        Scalar::Float => f32::from_bits(a).partial_cmp(&f32::from_bits(b)),
        Scalar::Int => Some((a as i32).cmp(&(b as i32))),
        Scalar::Uint | Scalar::Bool => Some(a.cmp(&b)),
    }
}

/// Returns the smaller or the larger of two scalars; the first if they are unordered.
fn extreme_of(scalar: Scalar, a: u32, b: u32, is_max: bool) -> u32 {
    let wanted = if is_max { Ordering::Greater } else { Ordering::Less };
    if order(scalar, b, a) == Some(wanted) { b } else { a }
}

pub(super) fn extreme(args: &[Arg<'_>], out: &mut [u32], is_max: bool) {
    let [a, b] = [args[0], args[1]];
    fill(out, |i| extreme_of(a.scalar, a.bits(i), b.bits(i), is_max));
}

pub(super) fn clamped(args: &[Arg<'_>], out: &mut [u32]) {
    let [x, low, high] = [args[0], args[1], args[2]];
    let above = |i| extreme_of(x.scalar, x.bits(i), low.bits(i), true);
    fill(out, |i| extreme_of(x.scalar, above(i), high.bits(i), false));
}

/// Unordered operands (NaN) make every comparison false except inequality.
pub(super) fn compare(op: Binary, args: &[Arg<'_>], out: &mut [u32]) {
    let [a, b] = [args[0], args[1]];
    let holds = |order: Option<Ordering>| match op {
        Binary::Less => order.is_some_and(Ordering::is_lt),
        Binary::LessEqual => order.is_some_and(Ordering::is_le),
        Binary::Greater => order.is_some_and(Ordering::is_gt),
        Binary::GreaterEqual => order.is_some_and(Ordering::is_ge),
        Binary::Equal => order.is_some_and(Ordering::is_eq),
        _ => !order.is_some_and(Ordering::is_eq),
    };
    fill(out, |i| holds(order(a.scalar, a.bits(i), b.bits(i))).into());
}

pub(super) fn mixed(args: &[Arg<'_>], out: &mut [u32]) {
    let [x, y, t] = [args[0], args[1], args[2]];
    match t.scalar {
        Scalar::Bool => fill(out, |i| if t.bits(i) != 0 { y.bits(i) } else { x.bits(i) }),
        _ => fill_floats(out, |i| x.float(i) * (1.0 - t.float(i)) + y.float(i) * t.float(i)),
    }
}

pub(super) fn smooth_step(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * (t * (3.0 - 2.0 * t))
}

pub(super) fn pack(args: &[Arg<'_>], out: &mut [u32], bits: fn(f32) -> u32) {
    out[0] = bits(args[0].float(0)) | bits(args[0].float(1)) << 16;
}

pub(super) fn unpack(args: &[Arg<'_>], out: &mut [u32], value: fn(u16) -> f32) {
    let bits = args[0].bits(0);
    fill_floats(out, |i| value((bits >> (16 * i)) as u16));
}

pub(super) fn snorm_bits(x: f32) -> u32 {
    (x.clamp(-1.0, 1.0) * 32767.0).round_ties_even() as i32 as u32 & 0xFFFF
}

pub(super) fn unorm_bits(x: f32) -> u32 {
    (x.clamp(0.0, 1.0) * 65535.0).round_ties_even() as u32
}

pub(super) fn snorm_value(bits: u16) -> f32 {
    (f32::from(bits as i16) / 32767.0).clamp(-1.0, 1.0)
}

pub(super) fn unorm_value(bits: u16) -> f32 {
    f32::from(bits) / 65535.0
}

pub(super) fn half_bits(x: f32) -> u32 {
    half::f16::from_f32(x).to_bits().into()
}

pub(super) fn half_value(bits: u16) -> f32 {
    half::f16::from_bits(bits).to_f32()
}

fn dot(a: Arg<'_>, b: Arg<'_>) -> f32 {
    a.floats().zip(b.floats()).map(|(x, y)| x * y).reduce(|sum, term| sum + term).unwrap_or(0.0)
}

/// Returns the length of a vector.
pub(super) fn length(floats: &[f32]) -> f32 {
    floats.iter().map(|x| x * x).reduce(|sum, term| sum + term).unwrap_or(0.0).sqrt()
}

pub(super) fn vector_length(args: &[Arg<'_>], out: &mut [u32]) {
    out[0] = length(&args[0].floats().collect::<Vec<_>>()).to_bits();
}

pub(super) fn distance(args: &[Arg<'_>], out: &mut [u32]) {
    let difference = args[0].floats().zip(args[1].floats()).map(|(x, y)| x - y);
    out[0] = length(&difference.collect::<Vec<_>>()).to_bits();
}

pub(super) fn dot_product(args: &[Arg<'_>], out: &mut [u32]) {
    out[0] = dot(args[0], args[1]).to_bits();
}

pub(super) fn cross(args: &[Arg<'_>], out: &mut [u32]) {
    let [a, b] = [args[0], args[1]];
    let minor = |i: usize, j: usize| a.float(i) * b.float(j) - b.float(i) * a.float(j);
    fill_floats(out, |i| minor((i + 1) % 3, (i + 2) % 3));
}

pub(super) fn normalized(args: &[Arg<'_>], out: &mut [u32]) {
    let length = length(&args[0].floats().collect::<Vec<_>>());
    let scale = 1.0 / length;
    fill_floats(out, |i| if length == 0.0 { 0.0 } else { args[0].float(i) * scale });
}

pub(super) fn face_forward(args: &[Arg<'_>], out: &mut [u32]) {
    let is_turned = dot(args[2], args[1]) >= 0.0;
    fill_floats(out, |i| if is_turned { -args[0].float(i) } else { args[0].float(i) });
}

pub(super) fn reflected(args: &[Arg<'_>], out: &mut [u32]) {
    let twice = 2.0 * dot(args[1], args[0]);
    fill_floats(out, |i| args[0].float(i) - twice * args[1].float(i));
}

pub(super) fn refracted(args: &[Arg<'_>], out: &mut [u32]) {
    let (eta, along) = (args[2].float(0), dot(args[1], args[0]));
    let k = 1.0 - eta * eta * (1.0 - along * along);
    let bent = |i: f32, n: f32| if k < 0.0 { 0.0 } else { eta * i - (eta * along + k.sqrt()) * n };
    fill_floats(out, |i| bent(args[0].float(i), args[1].float(i)));
}

pub(super) fn outer_product(args: &[Arg<'_>], out: &mut [u32]) {
    let rows = args[0].words.len();
    fill_floats(out, |i| args[0].float(i % rows) * args[1].float(i / rows));
}

pub(super) fn transposed(args: &[Arg<'_>], out: &mut [u32]) {
    let Arg { words, columns, .. } = args[0];
    let rows = words.len() / columns;
    fill(out, |i| words[(i % columns) * rows + i / columns]);
}

/// Returns the determinant of a square matrix, column by column.
pub(super) fn determinant(floats: &[f32]) -> f64 {
    determinant_of(&wide(floats), floats.len().isqrt())
}

pub(super) fn matrix_determinant(args: &[Arg<'_>], out: &mut [u32]) {
    out[0] = (determinant(&args[0].floats().collect::<Vec<_>>()) as f32).to_bits();
}

pub(super) fn inverted(args: &[Arg<'_>], out: &mut [u32]) {
    let n = args[0].columns;
    let m = wide(&args[0].floats().collect::<Vec<_>>());
    let determinant = determinant_of(&m, n);
    let inverse = |i: usize| if determinant == 0.0 { 0.0 } else { cofactor(&m, n, i % n, i / n) / determinant };
    fill_floats(out, |i| inverse(i) as f32);
}

/// Returns a matrix in 64 bits, column-major.
fn wide(floats: &[f32]) -> [f64; 16] {
    let mut out = [0.0; 16];
    out.iter_mut().zip(floats).for_each(|(slot, &value)| *slot = value.into());
    out
}

fn determinant_of(m: &[f64; 16], n: usize) -> f64 {
    if n == 1 {
        return m[0];
    }
    (0..n).map(|column| m[column * n] * cofactor(m, n, column, 0)).sum()
}

/// Returns the signed determinant of the matrix without one column and one row.
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
    sign * determinant_of(&minor, n - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtins::Builtin;

    fn named(name: &str) -> Builtin {
        Builtin::all().find(|builtin| builtin.name == name).unwrap()
    }

    fn floats(values: &[f32]) -> Vec<u32> {
        values.iter().map(|v| v.to_bits()).collect()
    }

    fn call(name: &str, args: &[(&[f32], usize)], count: usize) -> Vec<f32> {
        let words: Vec<Vec<u32>> = args.iter().map(|(values, _)| floats(values)).collect();
        let args: Vec<Arg<'_>> = words
            .iter()
            .zip(args)
            .map(|(words, &(_, columns))| Arg { words, scalar: Scalar::Float, columns })
            .collect();
        let mut folded = vec![0; count];
        assert!(named(name).fold(&args, &mut folded));
        folded.into_iter().map(f32::from_bits).collect()
    }

    #[test]
    fn scalars_are_broadcast_to_all_components() {
        assert_eq!(call("max", &[(&[1., -2., 3.], 1), (&[0.], 1)], 3), [1., 0., 3.]);
        assert_eq!(call("mod", &[(&[-1., 5.5], 1), (&[3.], 1)], 2), [2., 2.5]);
        assert_eq!(call("mix", &[(&[0., 10.], 1), (&[1., 20.], 1), (&[0.5], 1)], 2), [0.5, 15.]);
        assert_eq!(call("smoothstep", &[(&[0.], 1), (&[1.], 1), (&[0.5, 2.], 1)], 2), [0.5, 1.]);
    }

    /// The last bits are those of the operations to which OpenGL's compilers expand these functions.
    #[test]
    fn last_bits() {
        assert_eq!(call("normalize", &[(&[0.2, 0., -1.], 1)], 3)[0].to_bits(), 0x3e48_d2ab);
        assert_eq!(call("acos", &[(&[-0.447_213_6], 1)], 1), [2.034_546]);
        assert_eq!(call("acos", &[(&[-1., 0., 1.], 1)], 3), [2. * FRAC_PI_2, FRAC_PI_2, 0.]);
        assert_eq!(call("asin", &[(&[-1., 0., 1.], 1)], 3), [-FRAC_PI_2, 0., FRAC_PI_2]);
        assert_eq!(call("asin", &[(&[0.3], 1)], 1), [0.304_620_98]);
        assert_eq!(call("tanh", &[(&[-20., 0., 20.], 1)], 3), [-1., 0., 1.]);
    }

    #[test]
    fn matrices() {
        // Two columns of three rows become three columns of two rows.
        assert_eq!(call("transpose", &[(&[1., 2., 3., 4., 5., 6.], 2)], 6), [1., 4., 2., 5., 3., 6.]);
        assert_eq!(call("outerProduct", &[(&[1., 2., 3.], 1), (&[10., 20.], 1)], 6), [10., 20., 30., 20., 40., 60.]);
        assert_eq!(call("determinant", &[(&[2., 1., 5., 3.], 2)], 1), [1.]);
        assert_eq!(call("inverse", &[(&[2., 1., 5., 3.], 2)], 4), [3., -1., -5., 2.]);
        let m = [2., 0., 0., 0., 0., 4., 0., 0., 0., 0., 8., 0., 1., 2., 3., 1.];
        let inverse = call("inverse", &[(&m, 4)], 16);
        assert_eq!(inverse[12..], [-0.5, -0.5, -0.375, 1.]);
    }

    #[test]
    fn halves_round_to_even_and_round_trip() {
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
    fn function_outside_its_domain_is_zero_and_reported() {
        let words = floats(&[-1.0, 4.0]);
        let arg = Arg { words: &words, scalar: Scalar::Float, columns: 1 };
        let mut folded = [0; 2];
        assert!(named("sqrt").fold(&[arg], &mut folded));
        assert_eq!(folded, floats(&[0.0, 2.0])[..]);
        assert_eq!(named("sqrt").gap(&[arg]).and_then(|(_, component)| component), Some(0));
    }
}
