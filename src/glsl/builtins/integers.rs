//! Functions of the bits of integers: section 8.8 of GLSL 4.60, which GLSL ES 3.00 does not have.

use super::{
    bits::{self, bit_position},
    constant::Constant::Whole,
    overloads::{Overload, patterns::*, sig},
    row::{Operation::*, ROW, Row, Test::Component, UndefinedDomain, gap},
};
use crate::{ir::Math, types::Scalar};

const TO_INT: &[Overload] = &[sig(I, &[I]), sig(I, &[U])];

const EXTRACTED: &[UndefinedDomain] = &[gap(
    "bits outside of the 32 are undefined (8.8 of GLSL 4.60)",
    1..3,
    Component(|[_, offset, bits, _]| offset < 0.0 || bits < 0.0 || offset + bits > 32.0),
)];
const INSERTED: &[UndefinedDomain] = &[gap(
    "bits outside of the 32 are undefined (8.8 of GLSL 4.60)",
    2..4,
    Component(|[_, _, offset, bits]| offset < 0.0 || bits < 0.0 || offset + bits > 32.0),
)];

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    Row { name: "bitCount", params: "value", overloads: TO_INT, operation: BitPosition(Math::CountOneBits),
        constant: Whole(|args, out| bit_position(args, out, |bits, _| bits.count_ones())), since: 400,
        text: "The number of bits that are 1.", ..ROW },
    Row { name: "bitfieldExtract", params: "value, offset, bits",
        overloads: &[sig(I, &[I, I1, I1]), sig(U, &[U, I1, I1])], operation: BitfieldExtract,
        constant: Whole(bits::extracted), undefined_for: EXTRACTED, since: 400,
        text: "Bits offset to offset + bits - 1, moved to the lowest bits. Of an int, the highest of them is the sign; \
               of a uint the others are 0. Undefined outside of the 32 bits.", ..ROW },
    Row { name: "bitfieldInsert", params: "base, insert, offset, bits",
        overloads: &[sig(I, &[I, I, I1, I1]), sig(U, &[U, U, I1, I1])], operation: BitfieldInsert,
        constant: Whole(bits::inserted), undefined_for: INSERTED, since: 400,
        text: "base with bits offset to offset + bits - 1 from the lowest bits of insert. Undefined outside of the 32 \
               bits.", ..ROW },
    Row { name: "bitfieldReverse", params: "value", overloads: &[sig(I, &[I]), sig(U, &[U])],
        operation: Function(Math::ReverseBits),
        constant: Whole(|args, out| bit_position(args, out, |bits, _| bits.reverse_bits())), since: 400,
        text: "The 32 bits in reverse order.", ..ROW },
    Row { name: "findLSB", params: "value", overloads: TO_INT, operation: BitPosition(Math::FirstTrailingBit),
        constant: Whole(|args, out| bit_position(args, out, |bits, _| bits::lowest_bit(bits))), since: 400,
        text: "The position of the lowest bit that is 1; -1 for 0.", ..ROW },
    Row { name: "findMSB", params: "value", overloads: TO_INT, operation: BitPosition(Math::FirstLeadingBit),
        constant: Whole(|args, out| {
            bit_position(args, out, |bits, scalar| bits::highest_bit(bits, scalar == Scalar::Int));
        }),
        since: 400,
        text: "The position of the highest bit that is 1, or for a negative int of the highest bit that is 0; -1 \
               without one, as for 0 and the int -1.", ..ROW },
    Row { name: "uaddCarry", params: "x, y, carry", overloads: &[sig(U, &[U, U, U])], operation: AddCarry,
        writes: &[2], since: 400, text: "The lower 32 bits of x + y; carry is 1 if there are more, otherwise 0.", ..ROW },
    Row { name: "usubBorrow", params: "x, y, borrow", overloads: &[sig(U, &[U, U, U])], operation: SubtractBorrow,
        writes: &[2], since: 400,
        text: "x - y, plus 2 to the power of 32 if that is negative; borrow is then 1, otherwise 0.", ..ROW },
    Row { name: "umulExtended", params: "x, y, msb, lsb", overloads: &[sig(VOID, &[U, U, U, U])],
        operation: MultiplyExtended, writes: &[2, 3], since: 400,
        text: "The 64 bits of the product x · y: the upper 32 in msb, the lower ones in lsb.", ..ROW },
    Row { name: "imulExtended", params: "x, y, msb, lsb", overloads: &[sig(VOID, &[I, I, I, I])],
        operation: MultiplyExtended, writes: &[2, 3], since: 400,
        text: "The 64 bits of the product x · y: the upper 32 in msb, the lower ones in lsb.", ..ROW },
];
