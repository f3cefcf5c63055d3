//! The JSON of Shadertoy's API, its export and its plugins.
//!
//! Owns the conversion between that JSON and a [`super::Project`] in both directions, and Shadertoy's fixed ids.
//! Unknown members of `info` are preserved.

mod export;
mod form;
mod ids;
mod import;
mod losses;
mod parsed;
mod several;

pub use export::export;
pub use import::{holds_several, import, import_one};
pub use losses::losses;
pub(super) use parsed::utf16;
pub(super) use several::{of_several, one_of};

#[cfg(test)]
mod tests;
