//! Constant folding of functions of bits, and the same functions of single numbers for the interpreter: sections 8.3, 8.4
//! and 8.8 of GLSL 4.60. An int that is a position is -1 as the uint of all ones.

use super::constant::{Arg, fill, fill_floats};
use crate::types::Scalar;

pub(super) fn pack_bytes(args: &[Arg<'_>], out: &mut [u32], bits: fn(f32) -> u8) {
    out[0] = u32::from_le_bytes(std::array::from_fn(|i| bits(args[0].float(i))));
}

pub(super) fn unpack_bytes(args: &[Arg<'_>], out: &mut [u32], value: fn(u8) -> f32) {
    let bytes = args[0].bits(0).to_le_bytes();
    fill_floats(out, |i| value(bytes[i]));
}

pub(crate) fn snorm_byte(x: f32) -> u8 {
    (x.clamp(-1.0, 1.0) * 127.0).round_ties_even() as i8 as u8
}

pub(crate) fn unorm_byte(x: f32) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8
}

pub(crate) fn snorm_of_byte(bits: u8) -> f32 {
    (f32::from(bits as i8) / 127.0).clamp(-1.0, 1.0)
}

pub(crate) fn unorm_of_byte(bits: u8) -> f32 {
    f32::from(bits) / 255.0
}

/// Multiplies by a power of two in two steps, as devices do: its exponent may be larger than that of any float.
pub(super) fn scaled(args: &[Arg<'_>], out: &mut [u32]) {
    fill_floats(out, |i| {
        let exponent = (args[1].bits(i) as i32).clamp(-252, 254);
        let half = exponent >> 1;
        args[0].float(i) * 2f32.powi(half) * 2f32.powi(exponent - half)
    });
}

pub(super) fn bit_position(args: &[Arg<'_>], out: &mut [u32], f: fn(u32, Scalar) -> u32) {
    fill(out, |i| f(args[0].bits(i), args[0].scalar));
}

/// Returns the position of the lowest 1; all ones for 0.
pub(crate) fn lowest_bit(bits: u32) -> u32 {
    if bits == 0 { u32::MAX } else { bits.trailing_zeros() }
}

/// Returns the position of the highest 1, for a negative int of the highest 0; all ones without one.
pub(crate) fn highest_bit(bits: u32, is_int: bool) -> u32 {
    let bits = if is_int && (bits as i32) < 0 { !bits } else { bits };
    bits.checked_ilog2().unwrap_or(u32::MAX)
}

/// Returns the first bit and the number of bits of a part, clamped to the 32 bits.
fn part_of_bits(offset: u32, count: u32) -> (u32, u32) {
    let offset = offset.min(32);
    (offset, count.min(32 - offset))
}

/// Returns a part of the bits, extended with zeros or, for an int, with its sign.
pub(crate) fn extract_bits(bits: u32, offset: u32, count: u32, is_int: bool) -> u32 {
    match part_of_bits(offset, count) {
        (_, 0) => 0,
        (offset, count) => {
            let top = bits << (32 - offset - count);
            if is_int { (top as i32 >> (32 - count)) as u32 } else { top >> (32 - count) }
        }
    }
}

/// Returns bits with a part of them replaced by the lowest bits of `new`.
pub(crate) fn insert_bits(bits: u32, new: u32, offset: u32, count: u32) -> u32 {
    match part_of_bits(offset, count) {
        (_, 0) => bits,
        (offset, count) => {
            let mask = u32::MAX >> (32 - count) << offset;
            bits & !mask | new << offset & mask
        }
    }
}

/// Returns whether a part lies within the 32 bits.
fn is_within(offset: u32, count: u32) -> bool {
    offset <= 32 && count <= 32 && offset + count <= 32
}

pub(super) fn extracted(args: &[Arg<'_>], out: &mut [u32]) {
    let (offset, count) = (args[1].bits(0), args[2].bits(0));
    let is_int = args[0].scalar == Scalar::Int;
    let extract = |i: usize| extract_bits(args[0].bits(i), offset, count, is_int);
    fill(out, |i| if is_within(offset, count) { extract(i) } else { 0 });
}

pub(super) fn inserted(args: &[Arg<'_>], out: &mut [u32]) {
    let (offset, count) = (args[2].bits(0), args[3].bits(0));
    let insert = |i: usize| insert_bits(args[0].bits(i), args[1].bits(i), offset, count);
    fill(out, |i| if is_within(offset, count) { insert(i) } else { 0 });
}
