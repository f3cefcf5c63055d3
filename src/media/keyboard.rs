//! The keyboard as Shadertoy's 256x3 texture: row 0 held, row 1 pressed this frame, row 2 toggled.

use eddy_texture::{TexelFormat, TextureShape};
use std::sync::Arc;

/// The state of every key by JavaScript `keyCode`. Clones share it until a key changes: a run keeps one per frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keyboard {
    texels: Arc<[u8; Self::WIDTH * 3]>,
}

impl Default for Keyboard {
    fn default() -> Self {
        Self { texels: Arc::new([0; Self::WIDTH * 3]) }
    }
}

impl Keyboard {
    pub const WIDTH: usize = 256;
    pub const HEIGHT: usize = 3;
    /// The shape of [`Keyboard::bytes`].
    pub const SHAPE: TextureShape = TextureShape::flat(Self::WIDTH as u32, Self::HEIGHT as u32, TexelFormat::R8);

    /// Handles a key press. Auto-repeat (already held) is ignored, as on Shadertoy.
    pub fn press(&mut self, code: u8) {
        let (held, pressed, toggle) = Self::columns(code);
        if self.texels[held] != 0 {
            return;
        }
        let texels = Arc::make_mut(&mut self.texels);
        texels[held] = 255;
        texels[pressed] = 255;
        texels[toggle] = 255 - texels[toggle];
    }

    /// Handles a key release.
    pub fn release(&mut self, code: u8) {
        let (held, pressed, _) = Self::columns(code);
        let texels = Arc::make_mut(&mut self.texels);
        (texels[held], texels[pressed]) = (0, 0);
    }

    /// Releases all keys when the window loses focus. Toggles stay.
    pub fn release_all(&mut self) {
        Arc::make_mut(&mut self.texels)[..2 * Self::WIDTH].fill(0);
    }

    /// Called after every painted frame: "pressed" lasts one frame.
    pub fn frame_painted(&mut self) {
        let pressed = Self::WIDTH..2 * Self::WIDTH;
        if self.texels[pressed.clone()].iter().any(|byte| *byte != 0) {
            Arc::make_mut(&mut self.texels)[pressed].fill(0);
        }
    }

    pub fn is_held(&self, code: u8) -> bool {
        self.texels[usize::from(code)] != 0
    }

    /// Sets a whole row to exactly these codes.
    pub fn set_row(&mut self, row: usize, codes: &[u8]) {
        let row = &mut Arc::make_mut(&mut self.texels)[row * Self::WIDTH..][..Self::WIDTH];
        row.fill(0);
        codes.iter().for_each(|code| row[usize::from(*code)] = 255);
    }

    /// Returns 256x3 bytes, row 0 first.
    pub fn bytes(&self) -> &[u8] {
        &self.texels[..]
    }

    fn columns(code: u8) -> (usize, usize, usize) {
        let code = usize::from(code);
        (code, Self::WIDTH + code, 2 * Self::WIDTH + code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(k: &Keyboard, code: usize) -> [u8; 3] {
        [k.bytes()[code], k.bytes()[256 + code], k.bytes()[512 + code]]
    }

    #[test]
    fn pressed_lasts_one_frame_and_toggle_stays() {
        let mut k = Keyboard::default();
        k.press(32);
        k.press(32);
        assert_eq!(rows(&k, 32), [255, 255, 255]);
        k.frame_painted();
        k.press(32);
        assert_eq!(rows(&k, 32), [255, 0, 255], "auto-repeat does nothing");
        k.release(32);
        assert_eq!(rows(&k, 32), [0, 0, 255]);
        k.press(32);
        k.release(32);
        assert_eq!(rows(&k, 32), [0, 0, 0], "a tap shorter than a frame flips the toggle only");
    }
}
