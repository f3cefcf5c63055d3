//! One row of the list of uniforms: the name, what turns it, the value, and the way back to the default.
//!
//! Owns how each type of value is shown. What a value may be is the project's; a row asks the session to set one.

mod cells;
mod color;
mod control;
mod hex;
mod parts;
mod picker;
mod row;
mod scalar;

pub(super) use parts::HEIGHT;
pub(super) use row::show;
