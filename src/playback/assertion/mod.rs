//! Assertions about the texels of passes: `sum(buffer_a.x) within 1e-4 of 1`, `length(velocity.xy) in 0..limit`.
//!
//! Owns the language: its grammar, its evaluation, and the comments of a project that request quantities. Reads no
//! device and no files: the caller passes the texels. `eddy render --probe` takes a quantity, `--assert` an assertion
//! (with `let` statements before it), and [`Statements`] reads a text with several, such as the bounds of a preset.
//!
//! ```text
//! text       = {statement ";"}                            the last ";" may be left out; comments start with "//"
//! statement  = "let" name "=" (expression | string) | assertion
//! assertion  = quantity claim ["because" reason] {"unless" expression "because" reason}
//! quantity   = (values | reduction "(" values ")") [region]
//! values     = target ["." components] | "length(" target ["." components] ")"
//! target     = pass [":" index]
//! components = one to four of x, y, z, w, or of r, g, b, a
//! reduction  = "sum" | "min" | "max" | "mean" | "rms" | "nonfinite" | "energy" | "roughness"
//! region     = "from row" n | "except the first texel" | "except the last texel" | "at" x "," y ["size" w "x" h]
//! claim      = "in" expression ".." expression
//!            | "within" expression ["%"] "of" expression
//!            | ("<" | "<=" | ">" | ">=" | "==" | "=") expression
//! reason     = string | name
//! string     = '"' any characters except '"' '"'          a line break in it is a blank
//! ```
//!
//! `expression` and `name` are those of [`eddy_project::Expression`]. The names are: `first`, the quantity's value in
//! the first frame that was measured; `inf` and `pi`; what a `let` before it defines; the project's uniforms, of which
//! one with several components has the value of its largest; `width` and `height` of the canvas in pixels,
//! `longest_step` (the longest `iTimeDelta` so far, in seconds) and `dragged` (1 if the mouse is pressed at some time,
//! else 0).
//!
//! A quantity without a reduction is a value of each texel, and its claim is about all of them. Without components it
//! is each component that the pass stores; with several it is each of these, and `length` makes one number of them.
//! `rms` is the root of the mean square, `energy` half of the mean squared length, and `nonfinite` the number of NaN and
//! infinite values. `roughness` is the part of a component's variance that alternates from texel to texel (see
//! [`Reduction::Roughness`]). Texels are counted from the bottom left; `at` without `size` is one of them. A claim about
//! a region without texels holds.
//!
//! `in` includes both ends and fails for values that are not finite. NaN fails every claim. Where the condition of an
//! `unless` is not 0, the claim may fail for its reason, and the values must be finite and within [`EXCUSED_LIMIT`] or the
//! claim's own range.

mod assertions;
mod claim;
mod conditions;
mod declared;
mod find;
mod quantity;
mod reader;
mod region;
mod statements;

pub use assertions::{Assertion, Failure, Range};
pub use claim::EXCUSED_LIMIT;
pub use conditions::Conditions;
pub use declared::{Declared, Unmeasured, declared, stored};
pub use find::{Found, Worst};
pub use quantity::{Quantity, Reduction};
pub use reader::Reader;
pub use region::Region;
pub use statements::{StatementError, Statements};

#[cfg(test)]
mod tests;
