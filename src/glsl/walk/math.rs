//! The operators and functions of the language on cells.

use std::cmp::Ordering;

use super::number::{Cell, Float};
use crate::{
    builtins::bits,
    ir::{Binary, Math, Unary},
    types::{Scalar, Type},
};

/// Computes a unary operator on each component.
pub(super) fn unary<R: Float>(op: Unary, operand: Cell<R>) -> Cell<R> {
    match (op, operand) {
        (Unary::Negate, Cell::Float(value)) => Cell::Float(-value),
        (Unary::Negate, Cell::Bits(bits)) => Cell::Bits(bits.wrapping_neg()),
        (Unary::LogicalNot, _) => (!operand.is_true()).into(),
        (Unary::BitwiseNot, _) => Cell::Bits(!operand.bits()),
    }
}

/// Computes a binary operator on two scalars of one type; shift amounts are uints.
pub(super) fn binary<R: Float>(op: Binary, scalar: Scalar, left: Cell<R>, right: Cell<R>) -> Cell<R> {
    match scalar {
        Scalar::Float => float(op, left.float(), right.float()),
        Scalar::Int => int(op, left.bits() as i32, right.bits()),
        Scalar::Uint | Scalar::Bool => uint(op, left.bits(), right.bits()),
    }
}

fn float<R: Float>(op: Binary, left: R, right: R) -> Cell<R> {
    Cell::Float(match op {
        Binary::Add => left + right,
        Binary::Subtract => left - right,
        Binary::Multiply => left * right,
        Binary::Divide => left / right,
        Binary::Equal => return (left == right).into(),
        // Like SPIR-V's OpFOrdNotEqual: false for NaN. Lowering writes `!=` as `!(a == b)`.
        Binary::NotEqual => return left.partial_cmp(&right).is_some_and(Ordering::is_ne).into(),
        Binary::Less => return (left < right).into(),
        Binary::LessEqual => return (left <= right).into(),
        Binary::Greater => return (left > right).into(),
        Binary::GreaterEqual => return (left >= right).into(),
        other => unreachable!("{other:?} of floats"),
    })
}

fn int<R>(op: Binary, left: i32, right: u32) -> Cell<R> {
    let signed = right as i32;
    let value = match op {
        Binary::Add => left.wrapping_add(signed),
        Binary::Subtract => left.wrapping_sub(signed),
        Binary::Multiply => left.wrapping_mul(signed),
        Binary::Divide => left.checked_div(signed).unwrap_or(0),
        Binary::Modulo => left.checked_rem_euclid(signed).map_or(0, |rest| match signed < 0 && rest != 0 {
            true => rest + signed,
            false => rest,
        }),
        Binary::Less => (left < signed).into(),
        Binary::LessEqual => (left <= signed).into(),
        Binary::Greater => (left > signed).into(),
        Binary::GreaterEqual => (left >= signed).into(),
        Binary::ShiftRight => left.wrapping_shr(right),
        _ => return uint(op, left as u32, right),
    };
    Cell::Bits(value as u32)
}

fn uint<R>(op: Binary, left: u32, right: u32) -> Cell<R> {
    Cell::Bits(match op {
        Binary::Add => left.wrapping_add(right),
        Binary::Subtract => left.wrapping_sub(right),
        Binary::Multiply => left.wrapping_mul(right),
        Binary::Divide => left.checked_div(right).unwrap_or(0),
        Binary::Modulo => left.checked_rem(right).unwrap_or(0),
        Binary::Equal => (left == right).into(),
        Binary::NotEqual => (left != right).into(),
        Binary::Less => (left < right).into(),
        Binary::LessEqual => (left <= right).into(),
        Binary::Greater => (left > right).into(),
        Binary::GreaterEqual => (left >= right).into(),
        Binary::And | Binary::LogicalAnd => left & right,
        Binary::ExclusiveOr => left ^ right,
        Binary::InclusiveOr => left | right,
        Binary::ShiftLeft => left.wrapping_shl(right),
        Binary::ShiftRight => left.wrapping_shr(right),
    })
}

/// The bounds of an int's and of a uint's range that are exact in single precision: naga clamps floats to them first.
const INTS: (f64, f64) = (-2_147_483_648.0, 2_147_483_520.0);
const UINTS: (f64, f64) = (0.0, 4_294_967_040.0);

/// Converts a scalar to another type. Floats beyond an int's range convert to the nearest number that both types have,
/// and NaN converts to zero.
pub(super) fn convert<R: Float>(value: Cell<R>, from: Scalar, to: Scalar) -> Cell<R> {
    match (from, to) {
        (Scalar::Float, Scalar::Float) => value,
        (Scalar::Float, Scalar::Bool) => (value.float() != R::from_f64(0.0)).into(),
        (Scalar::Float, Scalar::Int) => Cell::Bits(value.float().to_f64().clamp(INTS.0, INTS.1) as i32 as u32),
        (Scalar::Float, Scalar::Uint) => Cell::Bits(value.float().to_f64().clamp(UINTS.0, UINTS.1) as u32),
        (Scalar::Int, Scalar::Float) => Cell::Float(R::from_f64((value.bits() as i32).into())),
        (_, Scalar::Float) => Cell::Float(R::from_f64(value.bits().into())),
        (_, Scalar::Bool) => value.is_true().into(),
        _ => value,
    }
}

/// Reinterprets the bits as another type.
pub(super) fn bitcast<R: Float>(value: Cell<R>, to: Scalar) -> Cell<R> {
    match to {
        Scalar::Float => Cell::Float(value.float()),
        _ => Cell::Bits(value.bits()),
    }
}

/// Computes a function of chapter 8; `ty` and `scalar` are those of the first argument.
pub(super) fn function<R: Float>(fun: Math, ty: Type, scalar: Scalar, args: &[&[Cell<R>]], out: &mut Vec<Cell<R>>) {
    let number = |arg: usize, i: usize| args[arg][i].float();
    let size = args[0].len();
    match fun {
        Math::Min | Math::Max if scalar != Scalar::Float => {
            let less = |a: u32, b: u32| if scalar == Scalar::Int { (a as i32) < b as i32 } else { a < b };
            out.extend((0..size).map(|i| {
                let (a, b) = (args[0][i].bits(), args[1][i].bits());
                Cell::Bits(if less(a, b) == (fun == Math::Min) { a } else { b })
            }));
        }
        Math::Clamp if scalar != Scalar::Float => {
            let mut above = Vec::with_capacity(size);
            function(Math::Max, ty, scalar, &args[..2], &mut above);
            function(Math::Min, ty, scalar, &[&above, args[2]], out);
        }
        Math::Abs if scalar != Scalar::Float => {
            out.extend(args[0].iter().map(|cell| Cell::Bits((cell.bits() as i32).wrapping_abs() as u32)));
        }
        Math::Sign if scalar != Scalar::Float => {
            out.extend(args[0].iter().map(|cell| Cell::Bits((cell.bits() as i32).signum() as u32)));
        }
        Math::CountOneBits | Math::ReverseBits | Math::FirstTrailingBit | Math::FirstLeadingBit => {
            out.extend(args[0].iter().map(|cell| Cell::Bits(of_bits(fun, cell.bits(), scalar))));
        }
        Math::ExtractBits => {
            let [offset, count] = [1, 2].map(|arg: usize| args[arg][0].bits());
            let extract = |bits| bits::extract_bits(bits, offset, count, scalar == Scalar::Int);
            out.extend(args[0].iter().map(|cell| Cell::Bits(extract(cell.bits()))));
        }
        Math::InsertBits => {
            let [offset, count] = [2, 3].map(|arg: usize| args[arg][0].bits());
            let pairs = args[0].iter().zip(args[1]);
            out.extend(pairs.map(|(base, new)| Cell::Bits(bits::insert_bits(base.bits(), new.bits(), offset, count))));
        }
        Math::Min | Math::Max | Math::Pow | Math::Atan2 => {
            out.extend((0..size).map(|i| Cell::Float(number(0, i).binary(fun, number(1, i)))));
        }
        Math::Clamp => out.extend(
            (0..size)
                .map(|i| Cell::Float(number(0, i).binary(Math::Max, number(1, i)).binary(Math::Min, number(2, i)))),
        ),
        Math::Mix => out.extend((0..size).map(|i| {
            let t = number(2, i);
            Cell::Float(number(0, i) * (R::from_f64(1.0) - t) + number(1, i) * t)
        })),
        Math::SmoothStep => out.extend((0..size).map(|i| {
            let (a, b) = (number(0, i), number(1, i));
            let t = ((number(2, i) - a) / (b - a)).unary(Math::Saturate);
            Cell::Float(t * t * (R::from_f64(3.0) - R::from_f64(2.0) * t))
        })),
        Math::Cross => out.extend(
            [(1, 2), (2, 0), (0, 1)]
                .map(|(i, j)| Cell::Float(number(0, i) * number(1, j) - number(0, j) * number(1, i))),
        ),
        Math::Length => out.push(Cell::Float(dot(args[0], args[0]).unary(Math::Sqrt))),
        Math::Normalize => {
            let scale = dot(args[0], args[0]).unary(Math::InverseSqrt);
            out.extend((0..size).map(|i| Cell::Float(number(0, i) * scale)));
        }
        Math::FaceForward => {
            let faces = dot(args[1], args[2]) < R::from_f64(0.0);
            out.extend((0..size).map(|i| Cell::Float(if faces { number(0, i) } else { -number(0, i) })));
        }
        Math::Transpose => {
            let Type::Matrix { columns, rows } = ty else { unreachable!("a matrix") };
            let (columns, rows) = (usize::from(columns), usize::from(rows));
            out.extend((0..rows).flat_map(|r| (0..columns).map(move |c| args[0][c * rows + r])));
        }
        Math::Determinant => out.push(Cell::Float(determinant(args[0]))),
        Math::Pack2x16snorm | Math::Pack2x16unorm | Math::Pack2x16float => {
            let half = |i| pack(fun, number(0, i).to_f32());
            out.push(Cell::Bits(half(0) | half(1) << 16));
        }
        Math::Unpack2x16snorm | Math::Unpack2x16unorm | Math::Unpack2x16float => {
            let bits = args[0][0].bits();
            out.extend([bits as u16, (bits >> 16) as u16].map(|half| Cell::Float(R::from_f64(unpack(fun, half)))));
        }
        Math::Pack4x8snorm | Math::Pack4x8unorm => {
            let byte = if fun == Math::Pack4x8snorm { bits::snorm_byte } else { bits::unorm_byte };
            out.push(Cell::Bits(u32::from_le_bytes(std::array::from_fn(|i| byte(number(0, i).to_f32())))));
        }
        Math::Unpack4x8snorm | Math::Unpack4x8unorm => {
            let bytes = args[0][0].bits().to_le_bytes();
            out.extend(bytes.map(|byte| {
                Cell::Float(R::from_f64(match fun {
                    Math::Unpack4x8snorm => (f64::from(byte as i8) / 127.0).max(-1.0),
                    _ => f64::from(byte) / 255.0,
                }))
            }));
        }
        _ => out.extend((0..size).map(|i| Cell::Float(number(0, i).unary(fun)))),
    }
}

/// Section 8.8 of GLSL 4.60.
fn of_bits(fun: Math, bits: u32, scalar: Scalar) -> u32 {
    match fun {
        Math::CountOneBits => bits.count_ones(),
        Math::ReverseBits => bits.reverse_bits(),
        Math::FirstTrailingBit => bits::lowest_bit(bits),
        _ => bits::highest_bit(bits, scalar == Scalar::Int),
    }
}

fn dot<R: Float>(a: &[Cell<R>], b: &[Cell<R>]) -> R {
    let products = a.iter().zip(b).map(|(a, b)| a.float() * b.float());
    products.reduce(|sum, product| sum + product).expect("a vector has components")
}

/// By the first column's minors.
fn determinant<R: Float>(matrix: &[Cell<R>]) -> R {
    let size = matrix.len().isqrt();
    if size == 1 {
        return matrix[0].float();
    }
    let mut sum = R::from_f64(0.0);
    for row in 0..size {
        let rest = |column: &[Cell<R>]| [&column[..row], &column[row + 1..]].concat();
        let minor: Vec<Cell<R>> = matrix.chunks_exact(size).skip(1).flat_map(rest).collect();
        let term = matrix[row].float() * determinant(&minor);
        sum = if row % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}

/// Section 8.4.
fn pack(fun: Math, value: f32) -> u32 {
    match fun {
        Math::Pack2x16snorm => u32::from((value.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16),
        Math::Pack2x16unorm => u32::from((value.clamp(0.0, 1.0) * 65535.0).round() as u16),
        _ => u32::from(half::f16::from_f32(value).to_bits()),
    }
}

fn unpack(fun: Math, half: u16) -> f64 {
    match fun {
        Math::Unpack2x16snorm => (f64::from(half as i16) / 32767.0).clamp(-1.0, 1.0),
        Math::Unpack2x16unorm => f64::from(half) / 65535.0,
        _ => half::f16::from_bits(half).to_f64(),
    }
}
