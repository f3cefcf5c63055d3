//! Uniforms that the program sets for which a text was written: their names, types and meanings.

use crate::CustomUniformType as Type;

/// A uniform, or an input from the vertex stage, that the program sets for which a text was written.
#[derive(Clone, Copy, Debug)]
pub struct HostUniform {
    pub name: &'static str,
    pub ty: Type,
    pub value: HostValue,
}

/// The value of a [`HostUniform`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HostValue {
    /// Seconds since frame 0.
    Time,
    /// Seconds since the previous frame.
    TimeDelta,
    /// The same, and 0 in frame 0.
    TimeDeltaFromZero,
    /// The number of the frame, where frame 0 has this number.
    Frame(i32),
    /// Year, month, day from 1 and seconds since midnight, where January has this number.
    Date(u8),
    /// Hours, minutes and seconds of the day.
    TimeOfDay,
    /// The position of the pointer, whether or not a button is down. Before it first moves it is at this part of the
    /// width and the height.
    Mouse(MouseUnit, [f32; 2]),
    /// The size of the target that the pass draws; the third component of a `vec3` is 1.
    Resolution,
    /// The position of the pixel in the target from 0 to 1, from the bottom left.
    UnitPosition,
    /// The position of the pixel in units of the height of the target, from its centre.
    CentredPosition,
    /// The position of the pixel in clip space: from -1 to 1, with z = 0 and w = 1.
    ClipPosition,
    /// Width divided by height of the picture, and 1.
    SurfaceSize,
    /// The same in every frame.
    Constant([f32; 4]),
    /// A value of the terminal that Ghostty simulates, by its row in [`crate::ghostty::uniforms`].
    Terminal(u8),
}

/// The coordinates of the pointer. All have their origin at the bottom left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MouseUnit {
    Pixels,
    /// From 0 to 1.
    Unit,
}

impl HostValue {
    /// Returns whether it is a value for all passes of a frame, in a slot of the block of uniforms. The others follow
    /// from the target and the position of the pixel.
    pub fn has_slot(self) -> bool {
        use HostValue as V;
        !matches!(self, V::Resolution | V::UnitPosition | V::CentredPosition | V::ClipPosition)
    }

    /// Returns a sentence part for documentation and the editor.
    pub fn about(self) -> String {
        match self {
            HostValue::Time => "time in seconds".into(),
            HostValue::TimeDelta | HostValue::TimeDeltaFromZero => "duration of the last frame in seconds".into(),
            HostValue::Frame(first) => format!("number of the frame, from {first}"),
            HostValue::Date(0) => "year, month (0 to 11), day, seconds since midnight".into(),
            HostValue::Date(_) => "year, month (1 to 12), day, seconds since midnight".into(),
            HostValue::TimeOfDay => "hours, minutes, seconds".into(),
            HostValue::Mouse(MouseUnit::Pixels, _) => "pointer in pixels from the bottom left".into(),
            HostValue::Mouse(MouseUnit::Unit, _) => "pointer from 0 to 1, from the bottom left".into(),
            HostValue::Resolution => "size in pixels of the target".into(),
            HostValue::UnitPosition => "position of the pixel from 0 to 1".into(),
            HostValue::CentredPosition => "position of the pixel from the centre, in heights".into(),
            HostValue::ClipPosition => "position of the pixel in clip space".into(),
            HostValue::SurfaceSize => "width divided by height, and 1".into(),
            HostValue::Constant(value) => format!("always {}", value[0]),
            HostValue::Terminal(row) => crate::ghostty::about(row).into(),
        }
    }
}

/// Returns a row.
pub(super) const fn uniform(name: &'static str, ty: Type, value: HostValue) -> HostUniform {
    HostUniform { name, ty, value }
}
