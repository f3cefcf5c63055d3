//! Requirements of drivers on the generated code.

use super::opt::PassSet;

/// The requirements of the driver that runs a pass on its code. None of this changes a picture, unless a loop is cut
/// short ([`Driver::max_loop_iterations`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Driver {
    /// The device cannot read storage buffers in a fragment shader: large constant tables are then in the memory of
    /// each invocation, which takes time to fill.
    pub tables_in_memory: bool,
    /// The driver recompiles a program for every frame, and keeps the result, where a branch depends only on uniforms:
    /// uniforms are read in a way that makes them look like per-pixel values. Mesa's lavapipe does this
    /// (`lvp_inline_uniforms.c`).
    pub opaque_uniforms: bool,
    /// A fragment stage must be able to discard, even though it never does: Mesa's llvmpipe is wrong where other
    /// fragments fail the depth test of a target of 16-bit floats (`generate_unswizzled_blend` in `lp_state_fs.c`).
    pub may_discard: bool,
    /// The angle of (0, 0) is NaN on the device, as in Direct3D: `atan` takes the angle of another point instead.
    pub nan_angle: bool,
    /// Long arrays are filled by loops, also with their initial zeros, and copied by loops
    /// ([`super::Compiled::initialized_arrays`]): Mesa's lavapipe takes minutes to compile stores of several hundred
    /// scalars one by one, which are slow in LLVM's `InstructionCombining.cpp`.
    pub array_loops: bool,
    /// Each loop that can change variables before its first exit starts with an exit that is never taken. Mesa's
    /// gallivm runs a loop until its last pixel leaves, and does not convert it to loop-closed SSA form
    /// (`nir_to_lcssa.c`): a value that is the same at all exits, and therefore needs no phi, is recomputed for pixels
    /// that have already left.
    pub loop_closing_exits: bool,
    /// Loops end where a fragment is discarded: Mesa's gallivm continues running them (`lp_bld_nir_soa.c`).
    pub discard_exits: bool,
    /// Reads of small arrays select among the elements: Mesa's gallivm stores to an array pixel by pixel
    /// (`lp_bld_nir_soa.c`).
    pub small_arrays: bool,
    /// Limits that loops count down to are hidden: Mesa assumes there that `min(c, x)` is at least `c`
    /// (`nir_loop_analyze.c`).
    pub opaque_limits: bool,
    /// Counters are hidden where they index an array in a nested loop: Mesa unrolls both loops, whatever the cost
    /// (`nir_loop_analyze.c`).
    pub opaque_counters: bool,
    /// Loops that may be endless are left after this many iterations of an invocation: while one runs, no other program
    /// can draw if the driver cannot stop it.
    pub max_loop_iterations: Option<u32>,
    /// Passes of the optimiser that are skipped: for developers of the compiler.
    pub disabled_optimisations: PassSet,
}
