//! Variables without zero initialisers.
//!
//! naga's writer gives every variable an initialiser of zeros. lavapipe turns it into one store per scalar in one
//! block, for which LLVM takes time that grows with about the cube of their number. The front end fills long arrays by
//! loops, and here their initialisers are removed.

use std::collections::{HashMap, HashSet};

use super::words::{HEADER, class, instructions, op};

/// Removes zero initialisers of the invocation's own variables that contain an array of at least this many scalars.
pub(super) fn without_zeros(words: &[u32], least_array: u32) -> Vec<u32> {
    let mut out = words[..HEADER].to_vec();
    // By id: the number of scalars, and that of the longest array inside.
    let mut types: HashMap<u32, (u32, u32)> = HashMap::new();
    let mut pointees: HashMap<u32, u32> = HashMap::new();
    let mut constants: HashMap<u32, u32> = HashMap::new();
    let mut nulls = HashSet::new();
    for (operation, instruction) in instructions(words) {
        let size = |id: u32| types.get(&id).copied().unwrap_or((1, 0));
        match (operation, &instruction[1..]) {
            (op::TYPE_VECTOR | op::TYPE_MATRIX, &[id, part, count]) => {
                let scalars = size(part).0.saturating_mul(count);
                types.insert(id, (scalars, 0));
            }
            (op::TYPE_ARRAY, &[id, element, len]) => {
                let len = constants.get(&len).copied().unwrap_or(0);
                let scalars = size(element).0.saturating_mul(len);
                types.insert(id, (scalars, scalars));
            }
            (op::TYPE_STRUCT, [id, members @ ..]) => {
                let sizes = members.iter().map(|&member| size(member));
                let all = sizes.fold((0u32, 0), |(sum, longest), (scalars, array)| {
                    (sum.saturating_add(scalars), array.max(longest))
                });
                types.insert(*id, all);
            }
            (op::TYPE_POINTER, &[id, _, pointee]) => _ = pointees.insert(id, pointee),
            (op::CONSTANT, &[_, id, value]) => _ = constants.insert(id, value),
            (op::CONSTANT_NULL, &[_, id]) => _ = nulls.insert(id),
            (op::VARIABLE, &[pointer, id, class @ (class::PRIVATE | class::FUNCTION), init])
                if nulls.contains(&init) && pointees.get(&pointer).is_some_and(|&ty| size(ty).1 >= least_array) =>
            {
                out.extend([4 << 16 | op::VARIABLE, pointer, id, class]);
                continue;
            }
            _ => {}
        }
        out.extend_from_slice(instruction);
    }
    out
}
