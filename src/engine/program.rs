//! A program: compiled passes, their pipelines, and the plan of a frame. It does not change from frame to frame.

use super::{
    external::{ChannelClock, External},
    mesh_instance::MeshInstance,
    pipelines::StagePipeline,
};
use eddy_glsl::{CustomUniformSet, MAX_CHANNELS, UniformSet, opt::specialise::Specialisable};
use eddy_gpu::Texture;
use eddy_graph::{Draw, FramePlan};
use eddy_project::{Camera, CustomUniform, CustomUniformValues, Dialect, PassName, PassSize};
use eddy_texture::Dimension;
use std::{ops::Range, sync::Arc};

/// A complete set of compiled passes and their plan. [`super::Builder`] builds it on any thread;
/// [`super::Engine::set_program`] swaps it in at once.
pub struct Program {
    pub(super) plan: FramePlan,
    /// One for each draw of the plan.
    pub(super) draws: Vec<CompiledDraw>,
    /// The textures that its channels read and that are not drawn by passes.
    pub(super) externals: Vec<External>,
    /// The author's own uniforms, in slot order.
    pub(super) custom_uniforms: Vec<CustomUniform>,
    /// The initial values.
    pub(super) custom_uniform_values: CustomUniformValues,
    /// The program that the texts are written for.
    pub(super) dialect: Dialect,
    /// Draws whose inputs have not changed are left out.
    pub(super) skips: bool,
}

/// The pipelines of one draw and the bindings of its channels.
pub(super) struct CompiledDraw {
    pub id: PassName,
    pub body: DrawBody,
    /// True if a program reads the geometry uniforms of meshes.
    pub reads_geometry: bool,
    pub channels: [BoundChannel; MAX_CHANNELS],
    /// Draws the contents of its target before frame 0.
    pub initial: Option<Box<FillProgram>>,
    /// Draws its outermost texels.
    pub boundary: Option<Box<FillProgram>>,
    /// The uniforms that it reads: Shadertoy's, and the author's own by their slots.
    pub uniforms: UniformSet,
    pub custom_uniforms: CustomUniformSet,
    /// All stages, for finding out what it reads at given values of uniforms; empty if that is not possible.
    pub specialisable: Vec<Specialisable>,
}

/// The triangle or the meshes of a draw.
pub(super) enum DrawBody {
    /// The triangle over the whole target.
    Screen(Arc<StagePipeline>),
    Meshes(Meshes),
}

/// Meshes that one camera views.
pub(super) struct Meshes {
    pub camera: Camera,
    /// The index of its first mesh among those of all draws.
    pub first: usize,
    pub programs: Vec<(Arc<StagePipeline>, MeshInstance)>,
}

impl DrawBody {
    /// The meshes with their camera, if it draws any.
    pub(crate) fn geometry(&self) -> Option<&Meshes> {
        match self {
            DrawBody::Screen(_) => None,
            DrawBody::Meshes(meshes) => Some(meshes),
        }
    }

    /// The indices of its meshes among those of all draws, each of which has a uniform block.
    pub(crate) fn geometry_blocks(&self) -> Range<usize> {
        self.geometry().map_or(0..0, |meshes| meshes.first..meshes.first + meshes.programs.len())
    }

    /// Returns whether it is drawn with a depth buffer.
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

/// A fill's program, and the draw that executes it.
pub(super) struct FillProgram {
    pub compiled: CompiledDraw,
    pub draw: Draw,
}

/// The filtering of the texels that a channel reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum FilterMode {
    /// Each read returns one texel.
    #[default]
    Nearest,
    /// The sampler filters.
    Sampler,
    /// The shader filters, because the device cannot filter the texture's format.
    Shader,
}

/// One channel of a compiled pass.
#[derive(Default)]
pub(super) struct BoundChannel {
    pub dimension: Dimension,
    pub texture: bool,
    pub sampler: bool,
    pub filter_mode: FilterMode,
    /// The external texture that it reads, in [`Program::externals`].
    pub external: Option<BoundExternal>,
    /// The value of `iChannelResolution` if the channel does not read a buffer.
    pub resolution: [f32; 3],
    /// The definition of `iChannelTime`.
    pub clock: ChannelClock,
    /// The size of the buffer the channel names, if it names one.
    pub buffer: Option<PassSize>,
}

/// A program's external texture, by its index there.
pub(super) struct BoundExternal {
    pub index: usize,
    pub texture: Texture,
}

impl Program {
    /// The author's own uniforms, in the order of their declarations.
    pub fn custom_uniforms(&self) -> &[CustomUniform] {
        &self.custom_uniforms
    }

    /// Every draw with its plan.
    pub(super) fn planned_draws(&self) -> impl Iterator<Item = (&CompiledDraw, &Draw)> {
        self.draws.iter().zip(&self.plan.draws)
    }

    /// Returns the total number of meshes that the passes draw.
    pub(super) fn meshes(&self) -> usize {
        self.draws.iter().map(|draw| draw.body.geometry_blocks().len()).sum()
    }

    /// The plan of each frame.
    pub fn plan(&self) -> &FramePlan {
        &self.plan
    }
}
