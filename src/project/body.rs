//! The content that a pass draws: every texel of its target, or meshes.

use super::{Geometry, MeshDraw, Source, Stage, TexelFormat};

/// The content of a pass. Code outside the engine uses the methods, which every body implements, instead of matching.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Body {
    /// Every texel of its one target, as on Shadertoy.
    #[default]
    Screen,
    /// Meshes, drawn with a depth buffer into its targets, which are cleared first.
    Meshes(Geometry),
}

impl Body {
    /// The meshes and their camera, for code that shows or edits them.
    pub fn geometry(&self) -> Option<&Geometry> {
        match self {
            Body::Screen => None,
            Body::Meshes(geometry) => Some(geometry),
        }
    }

    pub fn geometry_mut(&mut self) -> Option<&mut Geometry> {
        match self {
            Body::Screen => None,
            Body::Meshes(geometry) => Some(geometry),
        }
    }

    /// Returns whether one program computes each texel independently, over the whole target. Such a pass can be drawn
    /// in tiles and probed.
    pub fn is_screen(&self) -> bool {
        matches!(self, Body::Screen)
    }

    /// Returns whether the targets are cleared before drawing, so that nothing of the previous frame is visible.
    pub fn is_cleared(&self) -> bool {
        !self.is_screen()
    }

    /// The texts of stages other than the pass's own text.
    pub fn stages(&self) -> &[Source] {
        self.geometry().map_or(&[], |geometry| &geometry.stages)
    }

    pub fn stages_mut(&mut self) -> &mut [Source] {
        self.geometry_mut().map_or(&mut [], |geometry| &mut geometry.stages)
    }

    /// Every text that may contain a stage: the pass's own, and those of [`Body::stages`].
    pub fn texts(&self) -> impl Iterator<Item = Stage> + use<> {
        [Stage::Own].into_iter().chain((0..self.stages().len()).map(Stage::File))
    }

    /// The stages of all draws, in drawing order. A stage that several draws share is listed several times.
    pub fn drawn_stages(&self) -> Vec<Stage> {
        match self {
            Body::Screen => vec![Stage::Own],
            Body::Meshes(geometry) => geometry.draws.iter().flat_map(|draw| [draw.vertex, draw.fragment]).collect(),
        }
    }

    /// The meshes that are drawn.
    pub fn draws(&self) -> &[MeshDraw] {
        self.geometry().map_or(&[], |geometry| &geometry.draws)
    }

    pub fn draws_mut(&mut self) -> &mut [MeshDraw] {
        self.geometry_mut().map_or(&mut [], |geometry| &mut geometry.draws)
    }

    /// Returns the number of draws per frame, at least one.
    pub fn draw_count(&self) -> u64 {
        self.draws().len().max(1) as u64
    }

    /// Formats of the targets after the first.
    pub fn more_targets(&self) -> &[TexelFormat] {
        self.geometry().map_or(&[], |geometry| &geometry.more_targets)
    }
}
