//! Gamepads as a texture of 17x12 floats: three rows for each of four pads.
//!
//! Row 3p contains the axes of pad p: left x, left y, right x, right y, from -1 to 1, to the right and up; its column
//! 16 is 1 while the pad is connected. Row 3p + 1 contains the buttons in the order of [`PAD_BUTTONS`], triggers from 0
//! to 1. Row 3p + 2 is 1 for each button that was pressed in this frame. Missing parts are 0.

use eddy_project::{PAD_AXES, PAD_BUTTONS, PADS, PadPart};
use eddy_texture::{TexelFormat, TextureShape};
use std::sync::Arc;

const ROWS: usize = 3;
/// The value from which a button counts as pressed.
const PRESSED: f32 = 0.5;

/// The state of all gamepads. Clones share it until something moves: a run keeps one per frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Gamepads {
    texels: Arc<[f32; Self::TEXELS]>,
}

impl Default for Gamepads {
    fn default() -> Self {
        Self { texels: Arc::new([0.0; Self::TEXELS]) }
    }
}

impl Gamepads {
    pub const WIDTH: usize = PAD_BUTTONS.len();
    pub const HEIGHT: usize = ROWS * PADS;
    pub const TEXELS: usize = Self::WIDTH * Self::HEIGHT;
    /// The shape of [`Gamepads::texels`].
    pub const SHAPE: TextureShape = TextureShape::flat(Self::WIDTH as u32, Self::HEIGHT as u32, TexelFormat::R32f);
    /// The column that is 1 in the row of axes while a pad is connected.
    pub const CONNECTED: usize = Self::WIDTH - 1;

    fn at(pad: usize, row: usize, column: usize) -> Option<usize> {
        (pad < PADS && column < Self::WIDTH).then(|| (pad * ROWS + row) * Self::WIDTH + column)
    }

    /// Sets a texel by its index, the columns of row 0 first. Indices out of range and values outside of -1 to 1 are
    /// ignored.
    pub fn set(&mut self, index: usize, value: f32) {
        if index < Self::TEXELS && (-1.0..=1.0).contains(&value) && self.texels[index].to_bits() != value.to_bits() {
            Arc::make_mut(&mut self.texels)[index] = value;
        }
    }

    /// Sets a part of a pad. Returns whether a button went down or up.
    pub fn move_to(&mut self, pad: usize, part: PadPart, value: f32) -> bool {
        let (row, column) = match part {
            PadPart::Axis(place) if usize::from(place) < PAD_AXES.len() => (0, usize::from(place)),
            PadPart::Axis(_) => return false,
            PadPart::Button(place) => (1, usize::from(place)),
        };
        let Some(index) = Self::at(pad, row, column) else { return false };
        let before = self.texels[index];
        // Adding zero turns -0 into 0.
        self.set(index, value.clamp(if row == 0 { -1.0 } else { 0.0 }, 1.0) + 0.0);
        let is_down = self.texels[index] >= PRESSED;
        let turned = row == 1 && is_down != (before >= PRESSED);
        if let Some(pressed) = Self::at(pad, 2, column).filter(|_| turned && is_down) {
            self.set(pressed, 1.0);
        }
        turned
    }

    /// Connects a pad, or disconnects it and releases all its parts.
    pub fn connect(&mut self, pad: usize, is_there: bool) {
        if pad >= PADS {
            return;
        }
        if !is_there {
            (pad * ROWS * Self::WIDTH..(pad + 1) * ROWS * Self::WIDTH).for_each(|index| self.set(index, 0.0));
        }
        if let Some(index) = Self::at(pad, 0, Self::CONNECTED) {
            self.set(index, f32::from(u8::from(is_there)));
        }
    }

    /// Called after every drawn frame: "pressed" lasts one frame.
    pub fn frame_painted(&mut self) {
        for pad in 0..PADS {
            (0..Self::WIDTH).filter_map(|column| Self::at(pad, 2, column)).for_each(|index| self.set(index, 0.0));
        }
    }

    /// Returns 17x12 texels, row 0 first.
    pub fn texels(&self) -> &[f32; Self::TEXELS] {
        &self.texels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(pads: &Gamepads, pad: usize, column: usize) -> [f32; 3] {
        std::array::from_fn(|row| pads.texels()[(3 * pad + row) * 17 + column])
    }

    #[test]
    fn axes_buttons_and_presses_have_their_rows() {
        let mut pads = Gamepads::default();
        pads.connect(1, true);
        assert_eq!(rows(&pads, 1, 16), [1.0, 0.0, 0.0]);
        assert!(!pads.move_to(1, PadPart::parse("left-y").unwrap(), -0.5));
        assert_eq!(rows(&pads, 1, 1), [-0.5, 0.0, 0.0]);
        let trigger = PadPart::parse("right-trigger").unwrap();
        assert!(!pads.move_to(1, trigger, 0.25));
        assert_eq!(rows(&pads, 1, 7), [0.0, 0.25, 0.0], "not far enough for a press");
        assert!(pads.move_to(1, trigger, 0.75));
        assert_eq!(rows(&pads, 1, 7), [0.0, 0.75, 1.0]);
        pads.frame_painted();
        assert!(!pads.move_to(1, trigger, 1.0));
        assert_eq!(rows(&pads, 1, 7), [0.0, 1.0, 0.0], "it is held");
        pads.connect(1, false);
        assert_eq!(pads, Gamepads::default());
    }

    #[test]
    fn unknown_parts_and_pads_are_ignored() {
        let mut pads = Gamepads::default();
        for (pad, part) in [(4, PadPart::Button(0)), (0, PadPart::Button(17)), (0, PadPart::Axis(4))] {
            assert!(!pads.move_to(pad, part, 1.0));
        }
        pads.connect(4, true);
        pads.set(Gamepads::TEXELS, 1.0);
        pads.set(0, f32::NAN);
        pads.move_to(0, PadPart::Axis(0), f32::NAN);
        assert_eq!(pads, Gamepads::default());
    }
}
