//! Instructions in a module's words, by the SPIR-V specification, section 2.3, and the numbers used here, by sections
//! 3.7 (storage classes), 3.20 (decorations) and 3.52 (instructions).

/// The number of words before the first instruction. The fourth is the bound of the ids.
pub(super) const HEADER: usize = 5;
pub(super) const BOUND: usize = 3;

pub(super) mod op {
    pub(in crate::spirv) const NAME: u32 = 5;
    pub(in crate::spirv) const MEMBER_NAME: u32 = 6;
    pub(in crate::spirv) const EXT_INST_IMPORT: u32 = 11;
    pub(in crate::spirv) const EXT_INST: u32 = 12;
    pub(in crate::spirv) const TYPE_VECTOR: u32 = 23;
    pub(in crate::spirv) const TYPE_MATRIX: u32 = 24;
    pub(in crate::spirv) const TYPE_ARRAY: u32 = 28;
    pub(in crate::spirv) const TYPE_RUNTIME_ARRAY: u32 = 29;
    pub(in crate::spirv) const TYPE_STRUCT: u32 = 30;
    pub(in crate::spirv) const TYPE_POINTER: u32 = 32;
    pub(in crate::spirv) const CONSTANT: u32 = 43;
    pub(in crate::spirv) const CONSTANT_NULL: u32 = 46;
    pub(in crate::spirv) const FUNCTION_PARAMETER: u32 = 55;
    pub(in crate::spirv) const VARIABLE: u32 = 59;
    pub(in crate::spirv) const LOAD: u32 = 61;
    pub(in crate::spirv) const STORE: u32 = 62;
    pub(in crate::spirv) const ACCESS_CHAIN: u32 = 65;
    pub(in crate::spirv) const IN_BOUNDS_ACCESS_CHAIN: u32 = 66;
    pub(in crate::spirv) const DECORATE: u32 = 71;
    pub(in crate::spirv) const MEMBER_DECORATE: u32 = 72;
    pub(in crate::spirv) const COMPOSITE_CONSTRUCT: u32 = 80;
    pub(in crate::spirv) const COMPOSITE_EXTRACT: u32 = 81;
}

pub(super) mod class {
    pub(in crate::spirv) const UNIFORM: u32 = 2;
    pub(in crate::spirv) const PRIVATE: u32 = 6;
    pub(in crate::spirv) const FUNCTION: u32 = 7;
    pub(in crate::spirv) const PUSH_CONSTANT: u32 = 9;
    pub(in crate::spirv) const STORAGE_BUFFER: u32 = 12;
}

pub(super) mod decoration {
    pub(in crate::spirv) const ROW_MAJOR: u32 = 4;
    pub(in crate::spirv) const COLUMN_MAJOR: u32 = 5;
    pub(in crate::spirv) const ARRAY_STRIDE: u32 = 6;
    pub(in crate::spirv) const MATRIX_STRIDE: u32 = 7;
    pub(in crate::spirv) const OFFSET: u32 = 35;
}

/// Returns the instructions of a module: the number of the operation, and all words.
pub(super) fn instructions(words: &[u32]) -> impl Iterator<Item = (u32, &[u32])> {
    let mut rest = &words[HEADER..];
    std::iter::from_fn(move || {
        let &first = rest.first()?;
        let (instruction, after) = rest.split_at((first >> 16) as usize);
        rest = after;
        Some((first & 0xffff, instruction))
    })
}

/// Appends an instruction. `None` if it has more than the 65,535 words that an instruction can have.
pub(super) fn push(out: &mut Vec<u32>, op: u32, operands: impl IntoIterator<Item = u32>) -> Option<()> {
    let start = out.len();
    out.push(0);
    out.extend(operands);
    out[start] = u32::from(u16::try_from(out.len() - start).ok()?) << 16 | op;
    Some(())
}
