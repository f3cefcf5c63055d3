//! Owns what keys and the palette can ask of the picture: its size, its shape, and ways on where a frame took too long.

use crate::gui::geometry::Shape;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureAction {
    Shape(Shape),
    Scale(Scale),
    /// Always so many pixels.
    Size((u32, u32)),
    /// The field for any size.
    TypeSize,
    ResetUniforms,
    GoOn,
    Smaller,
    LastGood,
}

/// Says how large the picture is to the view's size, in eighths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale(u8);

impl Scale {
    pub fn factor(self) -> f32 {
        f32::from(self.0) / 8.0
    }

    pub fn name(self) -> &'static str {
        match self.0 {
            16 => "2x",
            8 => "1x",
            6 => "3/4",
            4 => "1/2",
            2 => "1/4",
            _ => "1/8",
        }
    }
}

/// The scales that are offered.
pub const SCALES: [Scale; 6] = [Scale(16), Scale(8), Scale(6), Scale(4), Scale(2), Scale(1)];
/// The sizes that are offered.
pub const SIZES: [(u32, u32); 8] =
    [(256, 144), (640, 360), (800, 450), (1280, 720), (1920, 1080), (3840, 2160), (512, 512), (1024, 1024)];
