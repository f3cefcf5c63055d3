//! Room on the stack for what recurses as deep as a text nests: the compiler runs on threads of any size.

/// Bytes that are left when more are taken. In debug builds a level of an expression takes some kilobytes.
pub(super) const STACK_LEFT: usize = 256 << 10;
/// Bytes that are taken at once.
pub(super) const STACK_MORE: usize = 4 << 20;

/// Does a part of a compile with all the room that statements and trees of the greatest depth take in any stage, naga's
/// among them. Memory that is not used is never touched.
pub(super) fn on_deep_stack<T>(work: impl FnOnce() -> T) -> T {
    stacker::maybe_grow(16 << 20, 64 << 20, work)
}
