//! Builds everything that a frame of a project needs and that is constant from frame to frame.

use super::{
    BuildError, EngineError, Sources,
    channels::{ChannelBinder, filter_mode, filter_mode_of_fill, size_warnings},
    compile::PassOptions,
    draft::{CompiledParts, DrawDraft},
    pipelines::PipelineCache,
    preamble::PreambleCache,
    program::{FilterMode, Program},
    sources::declared_dimensions,
    stage_cache::StageCache,
    trial::{Trial, TrialOrder},
    uploads::Uploads,
};
use eddy_diag::{self as diag, Diagnostic, SourceId, SourceMap};
use eddy_glsl::{Driver, Probe, opt::PassSet};
use eddy_gpu::Gpu;
use eddy_graph::{FramePlan, PassFacts};
use eddy_media::MediaSet;
use eddy_project::{FillKind, Pass, PassName, PassSettings, Project};
use eddy_texture::TexelFormat;

/// The requested pictures, and whether other passes may be omitted.
#[derive(Clone, Debug)]
pub struct BuildOptions {
    /// The passes whose pictures are requested; passes that they do not depend on are not in the frame. Empty: Image.
    /// For sound only, see [`BuildOptions::sound`].
    pub requested: Vec<PassName>,
    /// True to omit passes that are not read. If false (`--no-skip`), everything is drawn, with the same bytes in every
    /// picture.
    pub skip: bool,
    /// Disabled passes of the shader compiler's optimiser: for debugging the compiler.
    pub disabled_optimisations: PassSet,
    /// A value of a pass that is drawn into [`BuildOptions::probed`].
    pub probe: Option<(PassName, Probe)>,
    /// Compiles large programs in another process first, if the driver compiles on the CPU. Programs whose value is
    /// probed are not tried.
    pub trial: Option<Trial>,
    /// The width and height, multiples of 4, of the target that the first requested pass is drawn into tile by tile, by
    /// [`Engine::draw_tile`](super::Engine::draw_tile); `None`: its target has the size of its picture.
    pub tile: Option<(u32, u32)>,
}

impl BuildOptions {
    /// Builds only the sound pass, for [`Engine::draw_sound`](super::Engine::draw_sound). No other pass is compiled, so
    /// that their errors do not silence it; and no other build includes the sound pass, so that its errors affect no
    /// picture.
    pub fn sound() -> Self {
        Self { requested: vec![PassName::sound()], ..Self::default() }
    }

    fn is_sound(&self) -> bool {
        matches!(&self.requested[..], [pass] if pass.is_sound())
    }

    /// Returns whether a pass is compiled.
    fn compiles(&self, pass: &PassName) -> bool {
        pass.is_picture() != self.is_sound()
    }

    /// Returns the target of the probed value: 32-bit floats, NaN where the probe was not evaluated. A buffer draws it
    /// together with its picture, which other passes read, so both take one evaluation. The value of Image is drawn by
    /// a separate pass after all buffers: the picture of Image is drawn only if it is requested too.
    pub fn probed() -> PassName {
        PassName::buffer("probe of a value")
    }

    /// Draws the first value that the innermost expression at a byte offset of a text has in a pass, or the variable
    /// whose name is declared there, and only the passes that it depends on.
    #[must_use]
    pub fn probing(self, pass: PassName, source: SourceId, at: u32) -> Self {
        let probe = Some((pass, Probe { source, at, visit: 0 }));
        Self { requested: vec![BuildOptions::probed()], probe, ..self }
    }

    /// The pass that is drawn in tiles.
    fn tiled(&self) -> Option<PassName> {
        self.tile.map(|_| self.requested.first().cloned().unwrap_or_default())
    }

    /// The buffer that draws a probed value together with its picture.
    fn probed_buffer(&self) -> Option<(&PassName, Probe)> {
        self.probe.as_ref().filter(|(pass, _)| !pass.is_image()).map(|(pass, probe)| (pass, *probe))
    }
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self {
            requested: Vec::new(),
            skip: true,
            disabled_optimisations: PassSet::default(),
            probe: None,
            trial: None,
            tile: None,
        }
    }
}

/// A program and the compiler's diagnostics.
pub struct Built {
    pub program: Program,
    /// Warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
    pub sources: SourceMap,
    pub work: BuildWork,
}

/// The number of objects that a build created. All others were reused from earlier builds of the same [`Builder`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildWork {
    /// Compiled stages: distinct texts with their settings.
    pub stages: usize,
    /// Pipelines created from them.
    pub pipelines: usize,
}

/// Builds successive programs on one device. Reuses compiled stages, pipelines, pictures and meshes of the last two
/// programs.
pub struct Builder {
    gpu: Gpu,
    stages: StageCache,
    preamble: PreambleCache,
    pipelines: PipelineCache,
    uploads: Uploads,
}

impl Program {
    /// Builds a program without a cache; see [`Builder::build`].
    pub fn build(gpu: &Gpu, project: &Project, media: &MediaSet, options: &BuildOptions) -> Result<Built, BuildError> {
        Builder::new(gpu.clone()).build(project, media, options)
    }
}

impl Builder {
    pub fn new(gpu: Gpu) -> Self {
        let uploads = Uploads::new(&gpu);
        Self {
            gpu,
            stages: StageCache::of_pipelines(),
            preamble: PreambleCache::default(),
            pipelines: PipelineCache::default(),
            uploads,
        }
    }

    /// Compiles every pass, plans the frame and creates the pipelines of the passes it needs. `media` contains the
    /// pictures that the channels name; a missing one reads as an unloaded channel of Shadertoy's.
    pub fn build(&mut self, project: &Project, media: &MediaSet, options: &BuildOptions) -> Result<Built, BuildError> {
        let built = self.build_program(project, media, options);
        let is_whole = built.is_ok();
        let work = BuildWork { stages: self.stages.end_build(is_whole), pipelines: self.pipelines.end_build(is_whole) };
        self.uploads.end_build(is_whole);
        built.map(|built| Built { work, ..built })
    }

    fn build_program(
        &mut self,
        project: &Project,
        media: &MediaSet,
        options: &BuildOptions,
    ) -> Result<Built, BuildError> {
        let sources = project.sources();
        let texts = Sources::new(project);
        self.preamble.provide_to(&texts);
        let compiled = self.compile(project, &texts, media, options);
        self.preamble.update_from(&texts);
        let Compilation { drawable, passes, diagnostics } = match compiled {
            Ok(done) => done,
            Err(diagnostics) => return Err(BuildError::Diagnostics { diagnostics, sources }),
        };
        let beside = options.probed_buffer().map(|(pass, _)| pass);
        let drawn_by = |id: &PassName| beside.filter(|_| *id == BuildOptions::probed()).unwrap_or(id).clone();
        let wanted: Vec<PassName> = options.requested.iter().map(drawn_by).collect();
        for id in &wanted {
            if drawable.pass(id).is_none() {
                return Err(EngineError::NoSuchPass(id.title()).into());
            }
        }
        let facts: Vec<PassFacts> = passes.iter().map(|p| p.compiled.facts()).collect();
        // The inputs of Image's probe have been drawn by then, as for Image.
        let last = BuildOptions::probed();
        let mut plan = FramePlan::ending_with(&drawable, &facts, &wanted, options.skip, Some(&last));
        if let Some(pass) = drawable.passes.iter().position(|pass| Some(&pass.id) == beside) {
            plan.add_extra_target(pass, BuildOptions::probed());
        }
        if let (Some(tile), Some(id)) = (options.tile, options.tiled())
            && let Some(pass) = drawable.passes.iter().position(|pass| pass.id == id)
        {
            let undivided = |why| EngineError::Tiling { pass: id.title(), why };
            plan.tile(&drawable, pass, tile).map_err(undivided)?;
        }
        let mut passes: Vec<Option<CompiledParts>> = passes.into_iter().map(Some).collect();
        let mut drafts = Vec::with_capacity(plan.draws.len());
        let (gpu, uploads) = (&self.gpu, &mut self.uploads);
        let mut binder = ChannelBinder { gpu, project: &drawable, media, uploads, externals: Vec::new() };
        for draw in &plan.draws {
            let Some(parts) = passes[draw.pass].take() else { continue };
            drafts.push(DrawDraft::new(&mut binder, &plan, draw, parts)?);
        }
        let externals = binder.externals;
        let orders: Vec<_> = drafts.iter_mut().flat_map(DrawDraft::take_orders).collect();
        if let Some(trial) = options.trial.as_ref().filter(|_| self.gpu.compiles_here && options.probe.is_none()) {
            let adapter = &self.gpu.info.name;
            let order = TrialOrder { project, requested: &options.requested, skip: options.skip, adapter };
            let tried = trial.of(order, &texts, &self.pipelines.missing(&orders));
            if let Err(error) = tried {
                let diagnostics = diagnostics.into_iter().chain([error]).collect();
                return Err(BuildError::Diagnostics { diagnostics, sources });
            }
        }
        let mut made = self.pipelines.make(&self.gpu, orders)?.into_iter();
        let mut meshes = 0;
        let draws = drafts.into_iter().map(|draft| draft.finish(&mut made, &mut meshes)).collect();
        let program = Program {
            plan,
            draws,
            externals,
            custom_uniforms: texts.custom_uniforms().list.clone(),
            custom_uniform_values: project.custom_uniform_values.clone(),
            dialect: project.dialect,
            skips: options.skip,
        };
        Ok(Built { program, diagnostics, sources, work: BuildWork::default() })
    }

    /// Returns the compiler's options for `project.passes[index]`.
    fn options(&self, project: &Project, media: &MediaSet, index: usize, build: &BuildOptions) -> PassOptions {
        let filter_mode = filter_mode(&self.gpu, project, media, index);
        let driver = Driver {
            disabled_optimisations: build.disabled_optimisations,
            ..driver(&self.gpu, &project.passes[index])
        };
        let probe = build.probed_buffer().filter(|(id, _)| **id == project.passes[index].id).map(|(_, probe)| probe);
        let tiled = build.tiled().as_ref() == Some(&project.passes[index].id);
        PassOptions { bilinear_in_shader: filter_mode.map(|m| m == FilterMode::Shader), driver, probe, tiled }
    }

    /// Compiles every pass that can be drawn, and its fills.
    fn compile(
        &mut self,
        project: &Project,
        texts: &Sources<'_>,
        media: &MediaSet,
        build: &BuildOptions,
    ) -> Result<Compilation, Vec<Diagnostic>> {
        let mut drawable = project.clone();
        drawable.passes.clear();
        let mut passes = Vec::new();
        let mut diagnostics: Vec<Diagnostic> = texts.diagnostics.clone();
        if !build.is_sound() {
            diagnostics.extend(media.mesh_errors(project));
            diagnostics.extend(media.fill_errors(project));
        }
        let drawn = project.passes.iter().enumerate().filter(|(_, pass)| build.compiles(&pass.id));
        let options: Vec<_> = drawn.map(|(index, _)| (index, self.options(project, media, index, build))).collect();
        texts.compile_ahead(&mut self.stages, options);
        // Image is drawn last, wherever it is in the project: its probe is drawn after all buffers.
        let mut probe_of_image = None;
        for (index, pass) in project.passes.iter().enumerate().filter(|(_, pass)| build.compiles(&pass.id)) {
            let options = self.options(project, media, index, build);
            let mut said = size_warnings(&self.gpu, media, pass);
            let fills = FillKind::ALL.map(|kind| {
                let texels = pass.fill(kind).and_then(|fill| media.fill(fill.value.path()?));
                let by_hand = texels.is_some_and(|t| filter_mode_of_fill(&self.gpu, t) == FilterMode::Shader);
                let bilinear_in_shader = std::array::from_fn(|channel| channel == 0 && by_hand);
                let options = PassOptions { bilinear_in_shader, probe: None, tiled: false, ..options };
                match texts.compile_fill_with(&mut self.stages, index, kind, options)? {
                    Ok(mut fill) => {
                        said.append(&mut fill.diagnostics);
                        Some(fill)
                    }
                    Err(errors) => {
                        said.extend(errors);
                        None
                    }
                }
            });
            if build.probe.as_ref().is_some_and(|(id, _)| *id == pass.id) && !pass.body.is_screen() {
                said.push(Diagnostic::error(None, "a pass that draws meshes cannot be probed: probe another pass"));
            }
            if let Some((_, probe)) = build.probe.as_ref().filter(|(id, _)| id.is_image() && *id == pass.id) {
                match texts.compile_pass_with(&mut self.stages, index, PassOptions { probe: Some(*probe), ..options }) {
                    Ok(compiled) => {
                        let filter_mode = filter_mode(&self.gpu, project, media, index);
                        let dimensions = declared_dimensions(pass);
                        let parts = CompiledParts { compiled, fills: [None, None], filter_mode, dimensions };
                        probe_of_image = Some((probed(pass), parts));
                    }
                    Err(errors) => said.extend(errors),
                }
            }
            match texts.compile_pass_with(&mut self.stages, index, options) {
                Ok(mut compiled) => {
                    said.append(&mut compiled.diagnostics);
                    drawable.passes.push(if build.is_sound() { with_audible_channels(pass) } else { pass.clone() });
                    let filter_mode = filter_mode(&self.gpu, project, media, index);
                    let dimensions = declared_dimensions(pass);
                    passes.push(CompiledParts { compiled, fills, filter_mode, dimensions });
                }
                Err(errors) => said.extend(errors),
            }
            diag::append(&mut diagnostics, said);
        }
        if let Some((probe, parts)) = probe_of_image {
            drawable.passes.push(probe);
            passes.push(parts);
        }
        if diagnostics.iter().any(Diagnostic::is_error) {
            Err(diagnostics)
        } else {
            Ok(Compilation { drawable, passes, diagnostics })
        }
    }
}

/// The compiled passes that can be drawn, the project with only these, and every warning.
struct Compilation {
    drawable: Project,
    passes: Vec<CompiledParts>,
    diagnostics: Vec<Diagnostic>,
}

/// Returns the driver properties that affect the code of a pass.
pub(super) fn driver(gpu: &Gpu, pass: &Pass) -> Driver {
    let has_small_floats = pass.formats().into_iter().any(TexelFormat::is_small_float);
    Driver {
        tables_in_memory: !gpu.has_storage_buffers,
        opaque_uniforms: gpu.recompiles_for_uniforms,
        may_discard: gpu.keeps_denormals && has_small_floats,
        nan_angle: gpu.nan_angle,
        array_loops: gpu.wants_array_loops,
        loop_closing_exits: gpu.keeps_loops_open,
        discard_exits: gpu.runs_discarded,
        small_arrays: gpu.scatters_arrays,
        opaque_limits: gpu.misjudges_limits,
        opaque_counters: gpu.unrolls_whole_arrays,
        max_loop_iterations: gpu.max_loop_iterations,
        disabled_optimisations: PassSet::default(),
    }
}

/// The sound pass with the channels that it can read: other passes have not drawn a frame yet.
fn with_audible_channels(pass: &Pass) -> Pass {
    let mut pass = pass.clone();
    pass.bindings.retain(|channel| channel.input.kind().is_in_sound());
    pass
}

/// The pass that draws a value of Image.
fn probed(pass: &Pass) -> Pass {
    let PassSettings { size, region, .. } = pass.settings.clone();
    let settings = PassSettings { size, region, format: TexelFormat::Rgba32f, ..PassSettings::default() };
    Pass { id: BuildOptions::probed(), settings, ..pass.clone() }
}
