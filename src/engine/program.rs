//! A program: compiled passes, their pipelines, and the plan of a frame. It does not change from frame to frame.

use super::{
    external::{ChannelClock, External},
    pipelines::StagePipeline,
    placed::PlacedMesh,
};
use eddy_glsl::{CustomUniformSet, SLOTS, UniformSet};
use eddy_gpu::Texture;
use eddy_graph::{Draw, FramePlan};
use eddy_project::{Camera, CustomUniform, CustomUniformValues, Dialect, PassName, PassSize};
use eddy_texture::Dimension;
use std::{ops::Range, sync::Arc};

/// A whole set of compiled passes and their plan. [`super::Builder`] makes it on any thread;
/// [`super::Engine::set_program`] swaps it in at once.
pub struct Program {
    pub(super) plan: FramePlan,
    /// One for each of the plan's draws.
    pub(super) draws: Vec<CompiledDraw>,
    /// The textures that its channels read and no pass draws.
    pub(super) externals: Vec<External>,
    /// The author's own uniforms, in the order of their slots.
    pub(super) custom_uniforms: Vec<CustomUniform>,
    /// The values that the program starts with.
    pub(super) custom_uniform_values: CustomUniformValues,
    /// The program that the texts are written for.
    pub(super) dialect: Dialect,
}

/// The pipelines of one draw and what its channels are bound to.
pub(super) struct CompiledDraw {
    pub id: PassName,
    pub body: DrawBody,
    /// Some program reads what meshes are drawn with.
    pub reads_geometry: bool,
    pub channels: [BoundChannel; SLOTS],
    /// Draws what its target holds before frame 0.
    pub initial: Option<Box<FillProgram>>,
    /// Draws its outermost texels.
    pub boundary: Option<Box<FillProgram>>,
    /// The uniforms that are read: the site's, and the author's own by their slots.
    pub uniforms: UniformSet,
    pub custom_uniforms: CustomUniformSet,
}

/// The triangle or the meshes of a draw.
pub(super) enum DrawBody {
    /// The triangle over the whole target.
    Screen(Arc<StagePipeline>),
    Meshes(Meshes),
}

/// Meshes as one camera sees them.
pub(super) struct Meshes {
    pub camera: Camera,
    /// Place of the first among those of all draws.
    pub first: usize,
    pub programs: Vec<(Arc<StagePipeline>, PlacedMesh)>,
}

impl DrawBody {
    /// The meshes with their camera, if it draws any.
    pub(crate) fn geometry(&self) -> Option<&Meshes> {
        match self {
            DrawBody::Screen(_) => None,
            DrawBody::Meshes(meshes) => Some(meshes),
        }
    }

    /// The places of its meshes among those of all draws, each of which has a block of uniforms.
    pub(crate) fn geometry_blocks(&self) -> Range<usize> {
        self.geometry().map_or(0..0, |meshes| meshes.first..meshes.first + meshes.programs.len())
    }

    /// Returns whether it is drawn over a depth buffer.
    pub(crate) fn has_depth(&self) -> bool {
        self.geometry().is_some()
    }

    /// Every pipeline, in drawing order.
    pub(crate) fn pipelines(&self) -> impl Iterator<Item = &StagePipeline> {
        let (screen, meshes) = match self {
            DrawBody::Screen(pipeline) => (Some(pipeline), &[][..]),
            DrawBody::Meshes(meshes) => (None, &meshes.programs[..]),
        };
        screen.into_iter().chain(meshes.iter().map(|(pipeline, _)| pipeline)).map(|pipeline| &**pipeline)
    }
}

/// A fill's program, and the draw it is done as.
pub(super) struct FillProgram {
    pub compiled: CompiledDraw,
    pub draw: Draw,
}

/// The way in which the texels that a channel reads are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum FilterMode {
    /// Each read takes one texel.
    #[default]
    Nearest,
    /// The sampler mixes.
    Sampler,
    /// The shader mixes, because the device cannot filter the texture's format.
    Shader,
}

/// One channel of a compiled pass.
#[derive(Default)]
pub(super) struct BoundChannel {
    pub dimension: Dimension,
    pub texture: bool,
    pub sampler: bool,
    pub filter_mode: FilterMode,
    /// The one of [`Program::externals`] that it reads.
    pub external: Option<BoundExternal>,
    /// The value of `iChannelResolution` if the channel does not read a buffer.
    pub resolution: [f32; 3],
    /// Says what `iChannelTime` is.
    pub clock: ChannelClock,
    /// The size of the buffer the channel names, if it names one.
    pub buffer: Option<PassSize>,
}

/// One of a program's external textures, by its place there.
pub(super) struct BoundExternal {
    pub index: usize,
    pub texture: Texture,
}

impl Program {
    /// The author's own uniforms, in the order they are declared.
    pub fn custom_uniforms(&self) -> &[CustomUniform] {
        &self.custom_uniforms
    }

    /// Every draw with its plan.
    pub(super) fn planned_draws(&self) -> impl Iterator<Item = (&CompiledDraw, &Draw)> {
        self.draws.iter().zip(&self.plan.draws)
    }

    /// Returns the number of meshes that all passes together draw.
    pub(super) fn meshes(&self) -> usize {
        self.draws.iter().map(|draw| draw.body.geometry_blocks().len()).sum()
    }

    /// The plan of each frame.
    pub fn plan(&self) -> &FramePlan {
        &self.plan
    }
}
