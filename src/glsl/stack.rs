//! Stack space for functions that recurse as deep as a text nests, so that the compiler runs on threads of any stack
//! size.

/// The minimum number of free bytes: if there are fewer, more are allocated. In debug builds a level of an expression
/// takes some kilobytes.
pub(super) const STACK_LEFT: usize = 256 << 10;
/// The number of bytes allocated at a time.
pub(super) const STACK_MORE: usize = 4 << 20;

/// Runs a part of a compile with enough stack for statements and trees of the greatest depth in any stage, including
/// naga's. Unused memory is never touched.
pub(super) fn on_deep_stack<T>(work: impl FnOnce() -> T) -> T {
    stacker::maybe_grow(16 << 20, 64 << 20, work)
}
