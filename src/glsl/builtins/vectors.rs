//! Functions of vectors and matrices: sections 8.4 to 8.7.

use super::{
    constant::{
        self,
        Constant::{Each2, Whole},
        compare, determinant, length, pack, unpack,
    },
    overloads::{patterns::*, sig},
    row::{Operation::*, ROW, Row, Test::Vector, gap},
};
use crate::ir::{Binary, Math};

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    // 8.4 Packing.
    Row {
        name: "packSnorm2x16", params: "v", overloads: &[sig(U1, &[F2])], operation: Function(Math::Pack2x16snorm),
        constant: Whole(|args, out| pack(args, out, constant::snorm_bits)),
        text: "Two floats, clamped to -1..1, as 16-bit integers in one uint: round(v · 32767). v.x takes the low \
               bits.",
        ..ROW
    },
    Row {
        name: "unpackSnorm2x16", params: "p", overloads: &[sig(F2, &[U1])], operation: Function(Math::Unpack2x16snorm),
        constant: Whole(|args, out| unpack(args, out, constant::snorm_value)),
        text: "The two numbers in -1..1 that `packSnorm2x16` stored; x from the low bits.",
        ..ROW
    },
    Row {
        name: "packUnorm2x16", params: "v", overloads: &[sig(U1, &[F2])], operation: Function(Math::Pack2x16unorm),
        constant: Whole(|args, out| pack(args, out, constant::unorm_bits)),
        text: "Two floats, clamped to 0..1, as 16-bit integers in one uint: round(v · 65535). v.x takes the low \
               bits.",
        ..ROW
    },
    Row {
        name: "unpackUnorm2x16", params: "p", overloads: &[sig(F2, &[U1])], operation: Function(Math::Unpack2x16unorm),
        constant: Whole(|args, out| unpack(args, out, constant::unorm_value)),
        text: "The two numbers in 0..1 that `packUnorm2x16` stored; x from the low bits.",
        ..ROW
    },
    Row {
        name: "packHalf2x16", params: "v", overloads: &[sig(U1, &[F2])], operation: Function(Math::Pack2x16float),
        constant: Whole(|args, out| pack(args, out, constant::half_bits)),
        text: "Two floats as 16-bit floats in one uint: 11 bits of precision, up to 65504. v.x takes the low bits.",
        ..ROW
    },
    Row {
        name: "unpackHalf2x16", params: "p", overloads: &[sig(F2, &[U1])], operation: Function(Math::Unpack2x16float),
        constant: Whole(|args, out| unpack(args, out, constant::half_value)),
        text: "The two floats that `packHalf2x16` stored; x from the low bits.",
        ..ROW
    },
    // 8.5 Geometry; all but `cross` take floats as vectors of one.
    Row {
        name: "length", params: "x", overloads: &[sig(F1, &[F])], operation: Length,
        constant: Whole(constant::vector_length),
        text: "Length of a vector, sqrt(dot(x, x)); for a float its absolute value.",
        ..ROW
    },
    Row {
        name: "distance", params: "p0, p1", overloads: &[sig(F1, &[F, F])], operation: Distance,
        constant: Whole(constant::distance),
        text: "Distance of two points, length(p0 - p1).",
        ..ROW
    },
    Row {
        name: "dot", params: "x, y", overloads: &[sig(F1, &[F, F])], operation: Dot,
        constant: Whole(constant::dot_product),
        text: "Sum of the products of components: |x| · |y| · cos of the angle between them.",
        ..ROW
    },
    Row {
        name: "cross", params: "x, y", overloads: &[sig(F3, &[F3, F3])], operation: Function(Math::Cross),
        constant: Whole(constant::cross),
        text: "A vector perpendicular to both (right-hand rule); its length is the area of the parallelogram they \
               span.",
        ..ROW
    },
    Row {
        name: "normalize", params: "x", overloads: FLOAT, operation: Normalize, constant: Whole(constant::normalized),
        gaps: &[gap("normalize of a zero vector is undefined (8.5)", 0..1, Vector(|v| length(v) == 0.0))],
        text: "The vector of length 1 in the direction of x. Undefined for a vector of length 0.",
        ..ROW
    },
    Row {
        name: "faceforward", params: "N, I, Nref", overloads: &[sig(F, &[F, F, F])], operation: FaceForward,
        constant: Whole(constant::face_forward),
        text: "N where dot(Nref, I) < 0, else -N: a normal turned against the ray I.",
        ..ROW
    },
    Row {
        name: "reflect", params: "I, N", overloads: FLOATS, operation: Reflect, constant: Whole(constant::reflected),
        text: "The ray I reflected by a surface of normal N: I - 2 · dot(N, I) · N. N must have length 1.",
        ..ROW
    },
    Row {
        name: "refract", params: "I, N, eta", overloads: &[sig(F, &[F, F, F1])], operation: Refract,
        constant: Whole(constant::refracted),
        text: "The ray I refracted at a surface of normal N; eta is the ratio of the indices, from / into. The zero \
               vector where all is reflected. I and N must have length 1.",
        ..ROW
    },
    // 8.6 Matrices.
    Row {
        name: "matrixCompMult", params: "x, y", overloads: &[sig(MAT, &[MAT, MAT])], operation: MatrixCompMult,
        constant: Each2(|x, y| x * y),
        text: "Product component by component. The product of linear algebra is `x * y`.",
        ..ROW
    },
    Row {
        name: "outerProduct", params: "c, r",
        overloads: &[
            sig(mat(2, 2), &[F2, F2]), sig(mat(3, 3), &[F3, F3]), sig(mat(4, 4), &[F4, F4]),
            sig(mat(2, 3), &[F3, F2]), sig(mat(3, 2), &[F2, F3]), sig(mat(2, 4), &[F4, F2]),
            sig(mat(4, 2), &[F2, F4]), sig(mat(3, 4), &[F4, F3]), sig(mat(4, 3), &[F3, F4]),
        ],
        operation: OuterProduct, constant: Whole(constant::outer_product),
        text: "The matrix c · rᵀ: as many rows as c and as many columns as r have components.",
        ..ROW
    },
    Row {
        name: "transpose", params: "m", overloads: &[sig(TRANSPOSED, &[MAT])], operation: Function(Math::Transpose),
        constant: Whole(constant::transposed),
        text: "The matrix with rows and columns exchanged.",
        ..ROW
    },
    Row {
        name: "determinant", params: "m", overloads: &[sig(F1, &[SQUARE])], operation: Determinant,
        constant: Whole(constant::matrix_determinant),
        text: "Determinant of a square matrix: the signed volume its columns span; 0 where it has no inverse.",
        ..ROW
    },
    Row {
        name: "inverse", params: "m", overloads: &[sig(SQUARE, &[SQUARE])], operation: Inverse,
        constant: Whole(constant::inverted),
        gaps: &[gap("the inverse of a singular matrix is undefined (8.6)", 0..1, Vector(|m| determinant(m) == 0.0))],
        text: "Inverse of a square matrix. Undefined where the determinant is 0 or nearly so.",
        ..ROW
    },
    // 8.7 Vector relations, component by component.
    Row {
        name: "lessThan", params: "x, y", overloads: &[sig(VB, &[VF, VF]), sig(VB, &[VI, VI]), sig(VB, &[VU, VU])],
        operation: Compare(Binary::Less), constant: Whole(|args, out| compare(Binary::Less, args, out)),
        text: "x < y, component by component, as a vector of bools.",
        ..ROW
    },
    Row {
        name: "lessThanEqual", params: "x, y",
        overloads: &[sig(VB, &[VF, VF]), sig(VB, &[VI, VI]), sig(VB, &[VU, VU])],
        operation: Compare(Binary::LessEqual), constant: Whole(|args, out| compare(Binary::LessEqual, args, out)),
        text: "x <= y, component by component, as a vector of bools.",
        ..ROW
    },
    Row {
        name: "greaterThan", params: "x, y",
        overloads: &[sig(VB, &[VF, VF]), sig(VB, &[VI, VI]), sig(VB, &[VU, VU])],
        operation: Compare(Binary::Greater), constant: Whole(|args, out| compare(Binary::Greater, args, out)),
        text: "x > y, component by component, as a vector of bools.",
        ..ROW
    },
    Row {
        name: "greaterThanEqual", params: "x, y",
        overloads: &[sig(VB, &[VF, VF]), sig(VB, &[VI, VI]), sig(VB, &[VU, VU])],
        operation: Compare(Binary::GreaterEqual),
        constant: Whole(|args, out| compare(Binary::GreaterEqual, args, out)),
        text: "x >= y, component by component, as a vector of bools.",
        ..ROW
    },
    Row {
        name: "equal", params: "x, y",
        overloads: &[sig(VB, &[VF, VF]), sig(VB, &[VI, VI]), sig(VB, &[VU, VU]), sig(VB, &[VB, VB])],
        operation: Compare(Binary::Equal), constant: Whole(|args, out| compare(Binary::Equal, args, out)),
        text: "x == y, component by component, as a vector of bools. The operator `==` gives one bool for all.",
        ..ROW
    },
    Row {
        name: "notEqual", params: "x, y",
        overloads: &[sig(VB, &[VF, VF]), sig(VB, &[VI, VI]), sig(VB, &[VU, VU]), sig(VB, &[VB, VB])],
        operation: Compare(Binary::NotEqual), constant: Whole(|args, out| compare(Binary::NotEqual, args, out)),
        text: "x != y, component by component, as a vector of bools. The operator `!=` gives one bool for all.",
        ..ROW
    },
    Row {
        name: "any", params: "x", overloads: &[sig(BOOL, &[VB])], operation: Any,
        constant: Whole(|args, out| out[0] = u32::from(args[0].words.contains(&1))),
        text: "True if any component is true.",
        ..ROW
    },
    Row {
        name: "all", params: "x", overloads: &[sig(BOOL, &[VB])], operation: All,
        constant: Whole(|args, out| out[0] = u32::from(!args[0].words.contains(&0))),
        text: "True if all components are true.",
        ..ROW
    },
    Row {
        name: "not", params: "x", overloads: &[sig(VB, &[VB])], operation: Not, constant: Whole(constant::negated),
        text: "Each component negated. For a single bool write `!x`.",
        ..ROW
    },
];
