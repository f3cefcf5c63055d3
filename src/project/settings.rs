//! Settings in `eddy.toml` say how a pass is drawn: its size, the format of its texels, which of them are drawn, how
//! often a frame.

use super::{Boundary, Condition, Fill, Pass, PassName, TexelFormat};

/// Says how a pass is drawn. The default is what the site does.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassSettings {
    pub size: PassSize,
    pub format: TexelFormat,
    /// Only these texels are drawn, as far as the pass has them; the others keep what they held. `None`: all.
    pub region: Option<Region>,
    /// The content of the pass's texture of the frame before in frame 0. `None`: zeros.
    pub initial: Option<Fill>,
    /// Texels at the edge that are overwritten after each draw.
    pub boundary: Option<Boundary>,
    /// While it is false the pass is not drawn, and holds what it holds before frame 0. `None`: it is always drawn.
    pub when: Option<Condition>,
}

/// Size of a pass's picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PassSize {
    #[default]
    Canvas,
    /// The canvas times this, rounded, at least one texel each way.
    Scale(f64),
    /// Width and height in texels, whatever the canvas.
    Fixed(u32, u32),
}

impl PassSize {
    /// Width and height in texels for a canvas.
    pub fn of(self, (width, height): (u32, u32)) -> (u32, u32) {
        // `as` keeps within u32; a size no device has is refused where textures are made.
        let scaled = |v: u32, by: f64| ((f64::from(v) * by).round() as u32).max(1);
        match self {
            PassSize::Canvas => (width, height),
            PassSize::Scale(by) => (scaled(width, by), scaled(height, by)),
            PassSize::Fixed(width, height) => (width, height),
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
    /// The part of it that a picture of this size has; `None` if that is no texel.
    pub fn within(self, (width, height): (u32, u32)) -> Option<Region> {
        let w = width.saturating_sub(self.x).min(self.width);
        let h = height.saturating_sub(self.y).min(self.height);
        (w > 0 && h > 0).then_some(Region { width: w, height: h, ..self })
    }
}

/// Passes that follow each other and are drawn several times a frame: all once, in order, then all again. Every time
/// they see the same uniforms, and of each other what was drawn last.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The name in the file.
    pub name: String,
    /// In the order they are drawn; each of them buffers of the project, without another pass between them.
    pub passes: Vec<PassName>,
    /// At least 1.
    pub steps: u32,
}

/// The passes and meshes that are drawn for one frame: those of a group count as often as the group has steps.
pub(super) fn draws(passes: &[Pass], groups: &[Group]) -> u64 {
    let draws = |pass: &Pass| {
        let steps = groups.iter().find(|g| g.passes.contains(&pass.id)).map_or(1, |g| u64::from(g.steps));
        pass.body.draw_count().saturating_mul(steps)
    };
    passes.iter().map(draws).fold(0, u64::saturating_add)
}
