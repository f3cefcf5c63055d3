//! Says what drivers need of the code that they are given.

use super::opt::PassSet;

/// Holds what the driver that will run a pass needs of its code; none of it changes a picture that is drawn in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Driver {
    /// The device reads no storage buffers in a fragment shader: large constant tables are then memory of each
    /// invocation, which costs time to fill.
    pub tables_in_memory: bool,
    /// The driver compiles a program anew for every frame, and keeps what it made, where a branch depends on uniforms
    /// alone: they are read so that it takes them for values of the pixel. Mesa's lavapipe does so
    /// (`lvp_inline_uniforms.c`).
    pub opaque_uniforms: bool,
    /// A fragment stage has to be one that may discard, though it never does: Mesa's llvmpipe goes wrong where others
    /// fail the depth test of a target of 16-bit floats (`generate_unswizzled_blend` in `lp_state_fs.c`).
    pub may_discard: bool,
    /// The angle of (0, 0) is no number on the device, as Direct3D has it: `atan` asks for another one's.
    pub nan_angle: bool,
    /// Long arrays are filled, also with the zeros that they begin with, and copied by loops
    /// ([`super::Compiled::initialized_arrays`]): Mesa's lavapipe takes minutes to compile stores of some hundred
    /// scalars one by one, which LLVM's `InstructionCombining.cpp` is slow at.
    pub array_loops: bool,
    /// Each loop that can change variables before its first exit begins with an exit that is never taken. Mesa's
    /// gallivm runs a loop until its last pixel leaves, and does not bring it into loop-closed SSA form
    /// (`nir_to_lcssa.c`): a value that all exits agree on, and which needs no phi for that, is computed anew for
    /// pixels that have left.
    pub loop_closing_exits: bool,
    /// Loops end where a fragment is discarded: Mesa's gallivm goes on with it (`lp_bld_nir_soa.c`).
    pub discard_exits: bool,
    /// Reads of small arrays choose among the elements: Mesa's gallivm stores to an array pixel by pixel
    /// (`lp_bld_nir_soa.c`).
    pub small_arrays: bool,
    /// Limits that loops count down to are hidden: Mesa takes `min(c, x)` for at least `c` there
    /// (`nir_loop_analyze.c`).
    pub opaque_limits: bool,
    /// Counters are hidden where they index an array in a loop within a loop: Mesa writes both loops out, whatever that
    /// costs (`nir_loop_analyze.c`).
    pub opaque_counters: bool,
    /// Loops that may never end are left after so many rounds of an invocation: no other program draws while one runs,
    /// where the driver cannot stop it.
    pub most_rounds: Option<u32>,
    /// Passes of the optimiser that are left out: for who works on the compiler.
    pub without: PassSet,
}
