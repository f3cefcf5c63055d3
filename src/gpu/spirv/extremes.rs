//! Minima and maxima that ignore NaN.
//!
//! GLSL.std.450's `FMin`, `FMax` and `FClamp`, which naga writes, leave the result undefined if an operand is NaN, and
//! `NMin`, `NMax` and `NClamp` return the other operand. GPUs do the latter for both, and programs rely on it: the
//! highlights of `max(0.0, pow(dot(n, h), 8.0))` are black where the dot product is negative, and not NaN.

use super::words::{HEADER, instructions, op};

/// Pairs of instructions (GLSL.std.450 specification, section 2).
const OTHERS: [(u32, u32); 3] = [(37, 79), (40, 80), (43, 81)];

/// Replaces each minimum, maximum and clamp of floats by the one that ignores NaN.
pub(super) fn ignoring_nan(words: &[u32]) -> Vec<u32> {
    let mut out = words[..HEADER].to_vec();
    let mut library = None;
    for (operation, instruction) in instructions(words) {
        let start = out.len();
        out.extend_from_slice(instruction);
        match (operation, &instruction[1..]) {
            (op::EXT_INST_IMPORT, &[id, name, ..]) if name.to_le_bytes() == *b"GLSL" => library = Some(id),
            (op::EXT_INST, &[_, _, set, instruction, ..]) if Some(set) == library => {
                if let Some((_, other)) = OTHERS.iter().find(|(undefined, _)| *undefined == instruction) {
                    out[start + 4] = *other;
                }
            }
            _ => {}
        }
    }
    out
}
