//! A program: compiled passes, their pipelines, and the plan of a frame. It does not change from frame to frame.

use super::{pipelines::StagePipeline, placed::PlacedMesh};
use crate::{
    glsl::{ChannelKind, KnobSet, UniformSet},
    gpu::Texture,
    graph::{Draw, FramePlan},
    project::{Camera, Knob, KnobValues, PassId, PassSize},
};
use std::sync::Arc;

/// A whole set of compiled passes and their plan. [`super::Builder`] makes it on any thread; [`super::Engine::set_program`]
/// swaps it in at once.
pub struct Program {
    pub(super) plan: FramePlan,
    /// One for each of the plan's draws.
    pub(super) draws: Vec<CompiledDraw>,
    /// The author's own uniforms, in the order of their slots.
    pub(super) knobs: Vec<Knob>,
    /// The values that the program starts with.
    pub(super) knob_values: KnobValues,
}

/// The pipelines of one draw and what its channels are bound to.
pub(super) struct CompiledDraw {
    pub id: PassId,
    /// One, or one for each mesh the pass draws.
    pub programs: Vec<DrawProgram>,
    /// The camera of a pass that draws meshes.
    pub camera: Option<Camera>,
    /// Place of its first mesh among those of all draws.
    pub first_mesh: usize,
    /// Some program reads what meshes are drawn with.
    pub reads_geometry: bool,
    pub channels: [BoundChannel; 4],
    /// Draws what its target holds before frame 0.
    pub initial: Option<Box<FillProgram>>,
    /// Draws its outermost texels.
    pub boundary: Option<Box<FillProgram>>,
    /// The uniforms that are read: the site's, and the author's own by their slots.
    pub uniforms: UniformSet,
    pub knobs: KnobSet,
}

/// One program of a draw.
pub(super) struct DrawProgram {
    pub pipeline: Arc<StagePipeline>,
    /// `None`: the triangle over the whole target.
    pub mesh: Option<PlacedMesh>,
}

/// A fill's program, and the draw it is done as.
pub(super) struct FillProgram {
    pub compiled: CompiledDraw,
    pub draw: Draw,
}

/// How the texels that a channel reads are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Mixing {
    /// Each read takes one texel.
    #[default]
    Nearest,
    /// The sampler mixes.
    BySampler,
    /// The shader mixes, because the device cannot filter the texture's format.
    ByHand,
}

/// One channel of a compiled pass.
#[derive(Default)]
pub(super) struct BoundChannel {
    pub kind: ChannelKind,
    pub texture: bool,
    pub sampler: bool,
    pub mixing: Mixing,
    /// The picture, where the channel reads one and it is there.
    pub media: Option<Texture>,
    /// The value of `iChannelResolution` if the channel does not read a buffer.
    pub resolution: [f32; 3],
    /// The size of the buffer the channel names, if it names one.
    pub buffer: Option<PassSize>,
}

impl Program {
    /// The author's own uniforms, in the order they are declared.
    pub fn knobs(&self) -> &[Knob] {
        &self.knobs
    }

    /// Every draw with its plan.
    pub(super) fn planned_draws(&self) -> impl Iterator<Item = (&CompiledDraw, &Draw)> {
        self.draws.iter().zip(&self.plan.draws)
    }

    /// Returns the number of meshes that all passes together draw.
    pub(super) fn meshes(&self) -> usize {
        self.draws.iter().filter(|d| d.camera.is_some()).map(|d| d.programs.len()).sum()
    }

    /// The plan of each frame.
    pub fn plan(&self) -> &FramePlan {
        &self.plan
    }
}
