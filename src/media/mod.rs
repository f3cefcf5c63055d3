//! What feeds a channel besides a buffer: pictures, the keyboard, Eddy's own textures.
//!
//! Owns decoded texels and where they come from. Touches no GPU. Row 0 is the bottom: `vflip` has been applied to whatever
//! leaves this module.

pub mod builtin;
mod gather;
pub mod keyboard;
mod load;
mod site;

pub use gather::gather;
pub use keyboard::Keyboard;
pub use load::{MediaError, load};

use std::{collections::HashMap, sync::Arc};

/// Format of [`Texels`]. Never decoded from sRGB: a stored 128 reads as 128/255, as on the site.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TexelFormat {
    /// One byte a texel; reads as (r, 0, 0, 1).
    R8,
    /// Four bytes a texel, alpha not premultiplied.
    Rgba8,
    /// Four floats a texel.
    Rgba32Float,
}

impl TexelFormat {
    pub fn bytes(self) -> usize {
        match self {
            TexelFormat::R8 => 1,
            TexelFormat::Rgba8 => 4,
            TexelFormat::Rgba32Float => 16,
        }
    }
}

/// A decoded 2D picture. `bytes` holds `height` rows of `width` texels, row 0 at v = 0, no padding.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    pub width: u32,
    pub height: u32,
    pub format: TexelFormat,
    pub bytes: Vec<u8>,
}

/// The pictures a project needs, loaded: by what the channel names and whether it is flipped.
pub type MediaSet = HashMap<MediaKey, Arc<Texels>>;

/// What tells one loaded picture from another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MediaKey {
    pub media: crate::project::Media,
    pub vflip: bool,
}
