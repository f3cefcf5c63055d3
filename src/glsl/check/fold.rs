//! Values of operators and conversions on constants, bit for bit as on a device with 32-bit floats and wrapping ints.
//! What the specification leaves undefined has the value that ANGLE computes.

use crate::{
    hir::{BinaryOp, Scalar, Shape, UnaryOp},
    undefined,
};

/// A warning about a folded operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FoldWarning {
    DivisionByZero,
    ShiftRange,
}

/// Converts one component from a scalar type to another (section 5.4.1). Out-of-range floats saturate as ints, and
/// negative ones wrap as uints.
pub(super) fn convert(bits: u32, from: Scalar, to: Scalar) -> u32 {
    use Scalar::{Bool, Float, Int, Uint};
    let float = f32::from_bits(bits);
    match (from, to) {
        (Float, Float) | (Bool, Bool | Int | Uint) | (Int | Uint, Int | Uint) => bits,
        (Float, Int) => float as i32 as u32,
        (Float, Uint) if float < 0.0 => float as i32 as u32,
        (Float, Uint) => float as u32,
        (Float, Bool) => u32::from(float != 0.0),
        (Int | Uint, Bool) => u32::from(bits != 0),
        (Int, Float) => (bits as i32 as f32).to_bits(),
        (Uint, Float) => (bits as f32).to_bits(),
        (Bool, Float) => f32::to_bits(if bits != 0 { 1.0 } else { 0.0 }),
    }
}

/// Returns why a conversion is undefined, if it is.
pub(super) fn conversion_gap(bits: u32, from: Scalar, to: Scalar) -> Option<&'static str> {
    if from == Scalar::Float { undefined::conversion(f32::from_bits(bits), to) } else { None }
}

pub(super) fn unary(op: UnaryOp, scalar: Scalar, bits: u32) -> u32 {
    match op {
        UnaryOp::Negate if scalar == Scalar::Float => (-f32::from_bits(bits)).to_bits(),
        UnaryOp::Negate => bits.wrapping_neg(),
        UnaryOp::Not => u32::from(bits == 0),
        UnaryOp::BitNot => !bits,
    }
}

/// Evaluates one component of an operator; `right_signed` only affects shifts.
pub(super) fn binary(
    op: BinaryOp,
    scalar: Scalar,
    a: u32,
    b: u32,
    right_signed: bool,
    trouble: &mut Option<FoldWarning>,
) -> u32 {
    use BinaryOp as B;
    match (op, scalar) {
        (B::Shl | B::Shr, _) => {
            if b >= 32 || (right_signed && (b as i32) < 0) {
                *trouble = Some(FoldWarning::ShiftRange);
                return 0;
            }
            match op {
                B::Shl => a << b,
                _ if scalar == Scalar::Int => ((a as i32) >> b) as u32,
                _ => a >> b,
            }
        }
        (B::BitAnd, _) => a & b,
        (B::BitOr, _) => a | b,
        (B::BitXor, _) => a ^ b,
        (B::LogicalXor, _) => u32::from((a != 0) != (b != 0)),
        (_, Scalar::Float) => float(op, f32::from_bits(a), f32::from_bits(b)),
        (B::Add, _) => a.wrapping_add(b),
        (B::Sub, _) => a.wrapping_sub(b),
        (B::Mul, _) => a.wrapping_mul(b),
        (B::Div, _) if b == 0 => {
            *trouble = Some(FoldWarning::DivisionByZero);
            if scalar == Scalar::Int { i32::MAX as u32 } else { u32::MAX }
        }
        (B::Rem, _) if b == 0 => {
            *trouble = Some(FoldWarning::DivisionByZero);
            0
        }
        (B::Div, Scalar::Int) => (a as i32).checked_div(b as i32).unwrap_or(i32::MAX) as u32,
        (B::Rem, Scalar::Int) => (a as i32).checked_rem(b as i32).unwrap_or(0) as u32,
        (B::Div, _) => a / b,
        (B::Rem, _) => a % b,
        (B::Less, Scalar::Int) => u32::from((a as i32) < b as i32),
        (B::Greater, Scalar::Int) => u32::from(a as i32 > b as i32),
        (B::LessEqual, Scalar::Int) => u32::from(a as i32 <= b as i32),
        (B::GreaterEqual, Scalar::Int) => u32::from(a as i32 >= b as i32),
        (B::Less, _) => u32::from(a < b),
        (B::Greater, _) => u32::from(a > b),
        (B::LessEqual, _) => u32::from(a <= b),
        (B::GreaterEqual, _) => u32::from(a >= b),
        (B::Equal, _) => u32::from(a == b),
        (B::NotEqual, _) => u32::from(a != b),
    }
}

fn float(op: BinaryOp, a: f32, b: f32) -> u32 {
    use BinaryOp as B;
    match op {
        B::Add => (a + b).to_bits(),
        B::Sub => (a - b).to_bits(),
        B::Mul => (a * b).to_bits(),
        B::Div => (a / b).to_bits(),
        B::Less => u32::from(a < b),
        B::Greater => u32::from(a > b),
        B::LessEqual => u32::from(a <= b),
        B::GreaterEqual => u32::from(a >= b),
        B::Equal => u32::from(a == b),
        B::NotEqual => u32::from(a != b),
        B::Rem | B::BitAnd | B::BitOr | B::BitXor | B::Shl | B::Shr | B::LogicalXor => {
            unreachable!("the operator takes no floats")
        }
    }
}

/// The rows and columns of one side of a matrix product: a vector is one column on the right, one row on the left.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    pub columns: usize,
    pub rows: usize,
}

/// Computes a linear algebraic product, column-major, with sums from the first term on.
pub(super) fn product(shape: Shape, left: Grid, right: Grid, a: &[u32], b: &[u32]) -> super::words::ScalarWords {
    let (left, right) = match shape {
        Shape::VecMat => (Grid { columns: left.rows, rows: 1 }, right),
        _ => (left, right),
    };
    let at = |words: &[u32], grid: Grid, column: usize, row: usize| f32::from_bits(words[column * grid.rows + row]);
    let mut out = super::words::ScalarWords::default();
    for column in 0..right.columns {
        for row in 0..left.rows {
            let terms = (0..left.columns).map(|k| at(a, left, k, row) * at(b, right, column, k));
            out.push(terms.reduce(|sum, term| sum + term).unwrap_or(0.0).to_bits());
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ints_wrap_and_never_trap() {
        let mut trouble = None;
        let mut int = |op, a: i32, b: i32| binary(op, Scalar::Int, a as u32, b as u32, true, &mut trouble) as i32;
        assert_eq!(int(BinaryOp::Add, i32::MAX, 1), i32::MIN);
        assert_eq!(int(BinaryOp::Mul, 1 << 30, 4), 0);
        assert_eq!(int(BinaryOp::Div, i32::MIN, -1), i32::MAX);
        assert_eq!(int(BinaryOp::Div, -7, 2), -3);
        assert_eq!(int(BinaryOp::Rem, -7, 2), -1);
        assert_eq!(int(BinaryOp::Shr, -8, 1), -4);
        assert_eq!(trouble, None);
        assert_eq!(binary(BinaryOp::Div, Scalar::Int, 1, 0, true, &mut trouble), i32::MAX as u32);
        assert_eq!(trouble, Some(FoldWarning::DivisionByZero));
        assert_eq!(binary(BinaryOp::Shl, Scalar::Uint, 1, 32, false, &mut trouble), 0);
        assert_eq!(trouble, Some(FoldWarning::ShiftRange));
    }

    #[test]
    fn conversions_truncate_and_saturate() {
        let float = |x: f32| x.to_bits();
        assert_eq!(convert(float(-1.9), Scalar::Float, Scalar::Int) as i32, -1);
        assert_eq!(convert(float(-1.0), Scalar::Float, Scalar::Uint), u32::MAX);
        assert_eq!(convert(float(4e9), Scalar::Float, Scalar::Uint), 4_000_000_000);
        assert_eq!(convert(16_777_217, Scalar::Int, Scalar::Float), float(16_777_216.0));
        assert_eq!(convert(float(-0.0), Scalar::Float, Scalar::Bool), 0);
    }

    #[test]
    fn products_are_column_major() {
        let words = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        let floats =
            |w: super::super::words::ScalarWords| w.as_slice().iter().map(|&b| f32::from_bits(b)).collect::<Vec<_>>();
        // mat2x3 has two columns of three rows.
        let m = words(&[1., 2., 3., 4., 5., 6.]);
        let (m23, v2, v3) = (Grid { columns: 2, rows: 3 }, Grid { columns: 1, rows: 2 }, Grid { columns: 1, rows: 3 });
        assert_eq!(floats(product(Shape::MatVec, m23, v2, &m, &words(&[10., 1.]))), [14., 25., 36.]);
        assert_eq!(floats(product(Shape::VecMat, v3, m23, &words(&[1., 10., 100.]), &m)), [321., 654.]);
    }
}
