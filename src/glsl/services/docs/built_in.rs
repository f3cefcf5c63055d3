//! The documentation of one built-in function.

/// A built-in function: names of its parameters, in order, and its text.
#[derive(Clone, Copy, Debug)]
pub(in crate::services) struct Function {
    pub(super) params: &'static str,
    pub text: &'static str,
}

impl Function {
    /// Name of parameter `index` of an overload that has `count`.
    pub fn param(self, index: usize, count: usize) -> &'static str {
        // `atan` alone calls its one parameter something else than the first of two.
        if count == 1 && self.params == "y, x" {
            return "y_over_x";
        }
        self.params.split(", ").nth(index).unwrap_or("")
    }
}
