//! The JSON that Shadertoy's API, its export and its plugins speak.
//!
//! Owns both directions between that JSON and a [`super::Project`], and the site's fixed ids. What Eddy does not
//! understand of `info` it keeps and gives back.

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
