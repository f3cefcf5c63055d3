//! Options of lowering.

/// The layout of a program, for who comes behind lowering. None of it changes what the program computes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// The scalars from which on an array or structure is passed by reference; `None`: each is passed by value where it
    /// can be.
    pub by_reference: Option<u32>,
    /// The scalars from which on a constant that is passed by one call alone stands for the parameter.
    pub table: usize,
}
