//! One row of the list of uniforms: the name, the slider or other widget, the value, and the reset button.
//!
//! Owns how each type of value is shown. The project decides which values are valid; a row sends a command to set one.

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
