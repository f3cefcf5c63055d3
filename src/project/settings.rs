//! Settings in `eddy.toml` for drawing a pass: its size, the format of its texels, the region that is drawn, how often
//! per frame.

use super::{Boundary, Condition, Fill, Pass, PassName, TexelFormat};

/// The way a pass is drawn. The default is Shadertoy's behaviour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassSettings {
    pub size: PassSize,
    pub format: TexelFormat,
    /// Only these texels are drawn, as far as the pass has them; the others keep their values. `None`: all.
    pub region: Option<Region>,
    /// The contents of the pass's previous frame in frame 0. `None`: zeros.
    pub initial: Option<Fill>,
    /// Texels at the edge that are overwritten after each draw.
    pub boundary: Option<Boundary>,
    /// While it is false the pass is not drawn, and has its contents before frame 0. `None`: it is always drawn.
    pub when: Option<Condition>,
}

/// Size of a pass's picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PassSize {
    #[default]
    Canvas,
    /// The canvas scaled by this factor, rounded, at least one texel each way.
    Scale(f64),
    /// Width and height in texels, whatever the canvas.
    Fixed(u32, u32),
    /// Width and height, each with a rule of its own: a row of the canvas, for example.
    Sides(Side, Side),
}

/// The rule for a side of a pass's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// The canvas's side scaled by this factor, rounded, at least one texel.
    Scale(f64),
    /// The same, rounded down.
    Floor(f64),
    /// Texels, whatever the canvas.
    Fixed(u32),
}

impl Side {
    /// Returns the texels for a side of a canvas.
    pub fn of(self, canvas: u32) -> u32 {
        match self {
            // `as` saturates at u32; creating the texture fails for a size that no device supports.
            Side::Scale(by) => ((f64::from(canvas) * by).round() as u32).max(1),
            // A factor such as 1/3 is not exact: a side of 3 must give 1.
            Side::Floor(by) => ((f64::from(canvas) * by + 1e-6).floor() as u32).max(1),
            Side::Fixed(texels) => texels,
        }
    }

    /// Returns whether it is at least one texel for some canvas.
    pub fn is_valid(self) -> bool {
        match self {
            Side::Scale(by) | Side::Floor(by) => by.is_finite() && by > 0.0,
            Side::Fixed(texels) => texels > 0,
        }
    }
}

impl PassSize {
    /// Returns the width and height in texels for a canvas.
    pub fn of(self, (width, height): (u32, u32)) -> (u32, u32) {
        match self {
            PassSize::Canvas => (width, height),
            PassSize::Scale(by) => (Side::Scale(by).of(width), Side::Scale(by).of(height)),
            PassSize::Fixed(width, height) => (width, height),
            PassSize::Sides(x, y) => (x.of(width), y.of(height)),
        }
    }
}

/// A rectangle of texels, from the bottom left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Region {
    /// The part of it inside a picture of this size; `None` if it is empty.
    pub fn within(self, (width, height): (u32, u32)) -> Option<Region> {
        let w = width.saturating_sub(self.x).min(self.width);
        let h = height.saturating_sub(self.y).min(self.height);
        (w > 0 && h > 0).then_some(Region { width: w, height: h, ..self })
    }
}

/// Consecutive passes that are drawn several times a frame: all once, in order, then all again. Each time they see the
/// same uniforms, and the latest pictures of each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The name in the file.
    pub name: String,
    /// Buffers of the project in drawing order, without another pass between them.
    pub passes: Vec<PassName>,
    /// At least 1.
    pub steps: u32,
}

/// Returns the number of passes and meshes that are drawn for one frame: those of a group count once per step.
pub(super) fn draws(passes: &[Pass], groups: &[Group]) -> u64 {
    let draws = |pass: &Pass| {
        let steps = groups.iter().find(|g| g.passes.contains(&pass.id)).map_or(1, |g| u64::from(g.steps));
        pass.body.draw_count().saturating_mul(steps)
    };
    passes.iter().map(draws).fold(0, u64::saturating_add)
}
