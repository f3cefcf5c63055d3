//! From a project to everything a frame needs that does not change from frame to frame.

use super::{
    BuildError, EngineError, Sources,
    channels::{ChannelBinder, channel_bindings, mixing, mixing_of_fill},
    compile::PassOptions,
    compiled::CompiledPass,
    pipelines::{MeshState, PipelineCache, PipelineOrder, StagePipeline},
    placed::PlacedMesh,
    program::{BoundChannel, CompiledDraw, DrawProgram, FillProgram, Mixing, Program},
    stage_cache::StageCache,
    uploads::Uploads,
};
use crate::{
    diag::{Diagnostic, SourceMap},
    glsl::{Driver, interface},
    gpu::{Binding, Gpu},
    graph::{ChannelFacts, Draw, FramePlan, PassFacts},
    media::MediaSet,
    project::{FillKind, Input, Media, Pass, PassFormat, PassId, Project},
};
use std::sync::Arc;

/// What may be left out, and what is wanted.
#[derive(Clone, Debug)]
pub struct BuildOptions {
    /// The passes whose pictures are wanted; nothing they do not need is compiled into the frame. Empty: Image.
    pub wanted: Vec<PassId>,
    /// Leave out what nobody reads. Off (`--no-skip`), everything is drawn, with the same bytes in every picture.
    pub skip: bool,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { wanted: Vec::new(), skip: true }
    }
}

/// A program and what the compiler wants to say of it.
pub struct Built {
    pub program: Program,
    /// Warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
    pub sources: SourceMap,
    pub work: BuildWork,
}

/// What a build had to make; everything else was there from earlier builds of the same [`Builder`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildWork {
    /// Stages that were compiled: texts with their settings, each distinct one once.
    pub stages: usize,
    /// Pipelines that were made of them.
    pub pipelines: usize,
}

/// Builds programs on one device, one after the other. Compiled stages, pipelines, pictures and meshes that the last two
/// programs have are not made again.
pub struct Builder {
    gpu: Gpu,
    stages: StageCache,
    pipelines: PipelineCache,
    uploads: Uploads,
}

impl Program {
    /// Builds a program, with nothing from before; see [`Builder::build`].
    pub fn build(gpu: &Gpu, project: &Project, media: &MediaSet, options: &BuildOptions) -> Result<Built, BuildError> {
        Builder::new(gpu.clone()).build(project, media, options)
    }
}

impl Builder {
    pub fn new(gpu: Gpu) -> Self {
        let uploads = Uploads::new(&gpu);
        Self { gpu, stages: StageCache::default(), pipelines: PipelineCache::default(), uploads }
    }

    /// Compiles every pass, plans the frame and makes the pipelines of the passes it needs. `media` holds the pictures the
    /// channels name; one that is missing reads as the site's unloaded channel.
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
        let Compilation { drawable, passes, diagnostics } = match self.compile(project, &texts, media) {
            Ok(done) => done,
            Err(diagnostics) => return Err(BuildError::Diagnostics { diagnostics, sources }),
        };
        for id in &options.wanted {
            if drawable.pass(id).is_none() {
                return Err(EngineError::NoSuchPass(id.title()).into());
            }
        }
        let facts: Vec<PassFacts> = passes.iter().map(|p| facts(&p.compiled)).collect();
        let plan = FramePlan::new(&drawable, &facts, &options.wanted, options.skip);
        let mut passes: Vec<Option<CompiledParts>> = passes.into_iter().map(Some).collect();
        let mut drafts = Vec::with_capacity(plan.draws.len());
        for draw in &plan.draws {
            let Some(parts) = passes[draw.pass].take() else { continue };
            drafts.push(self.draft(&drawable, media, &plan, draw, parts)?);
        }
        let orders = drafts.iter_mut().flat_map(DrawDraft::take_orders).collect();
        let mut made = self.pipelines.make(&self.gpu, orders)?.into_iter();
        let mut draws: Vec<CompiledDraw> = drafts.into_iter().map(|draft| draft.finish(&mut made)).collect();
        let mut first_mesh = 0;
        for draw in draws.iter_mut().filter(|d| d.camera.is_some()) {
            draw.first_mesh = first_mesh;
            first_mesh += draw.programs.len();
        }
        let program =
            Program { plan, draws, knobs: texts.knobs().list.clone(), knob_values: project.knob_values.clone() };
        Ok(Built { program, diagnostics, sources, work: BuildWork::default() })
    }

    /// Compiles every pass that can be drawn, and its fills.
    fn compile(
        &mut self,
        project: &Project,
        texts: &Sources<'_>,
        media: &MediaSet,
    ) -> Result<Compilation, Vec<Diagnostic>> {
        let mut drawable = project.clone();
        drawable.passes.clear();
        let mut passes = Vec::new();
        let mut diagnostics: Vec<Diagnostic> = texts.diagnostics.clone();
        diagnostics.extend(media.mesh_errors(project));
        diagnostics.extend(media.fill_errors(project));
        for (index, pass) in project.passes.iter().enumerate() {
            if matches!(pass.id, PassId::Cubemap | PassId::Sound) {
                let what = pass.id.title();
                diagnostics.push(Diagnostic::warning(
                    None,
                    format!("the pass {what} is not drawn; what reads it reads black"),
                ));
                continue;
            }
            let driver = driver(&self.gpu, pass);
            let mut said = Vec::new();
            let fills = FillKind::ALL.map(|kind| {
                let texels = pass.fill(kind).and_then(|fill| media.fill(fill.value.path()?));
                let by_hand = texels.is_some_and(|t| mixing_of_fill(&self.gpu, t) == Mixing::ByHand);
                let options = PassOptions { bilinear_by_hand: [by_hand, false, false, false], driver };
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
            let mixing = mixing(&self.gpu, project, media, index);
            let options = PassOptions { bilinear_by_hand: mixing.map(|m| m == Mixing::ByHand), driver };
            match texts.compile_pass_with(&mut self.stages, index, options) {
                Ok(mut compiled) => {
                    said.append(&mut compiled.diagnostics);
                    drawable.passes.push(without_cubemap_passes(pass.clone()));
                    passes.push(CompiledParts { compiled, fills, mixing });
                }
                Err(errors) => said.extend(errors),
            }
            for d in said {
                // What is wrong in Common is found again in every pass.
                if !diagnostics.contains(&d) {
                    diagnostics.push(d);
                }
            }
        }
        if diagnostics.iter().any(Diagnostic::is_error) {
            Err(diagnostics)
        } else {
            Ok(Compilation { drawable, passes, diagnostics })
        }
    }

    /// Uploads what a draw reads, and says which pipelines it needs.
    fn draft(
        &mut self,
        project: &Project,
        media: &MediaSet,
        plan: &FramePlan,
        draw: &Draw,
        parts: CompiledParts,
    ) -> Result<DrawDraft, EngineError> {
        let pass = &project.passes[draw.pass];
        let CompiledParts { compiled, fills, mixing } = parts;
        let binder = ChannelBinder { gpu: &self.gpu, project, media };
        let mut channels: [BoundChannel; 4] = Default::default();
        for (index, bound) in channels.iter_mut().enumerate() {
            let mips = draw.reads[index].as_ref().is_some_and(|r| r.mips);
            let (channel, used) = (pass.channels[index].as_ref(), compiled.reflection.channels[index]);
            *bound = binder.bind(&mut self.uploads, channel, used, mixing[index], mips)?;
        }
        let geometry = pass.settings.geometry.as_ref();
        let states = geometry.map_or(Vec::new(), |g| g.draws.iter().map(MeshState::of).collect());
        let meshes = geometry.map_or(Ok(Vec::new()), |g| self.uploads.placed(&self.gpu, media, g))?;
        let formats: Vec<PassFormat> = plan.targets[draw.targets.clone()].iter().map(|t| t.format).collect();
        let mut done = DrawDraft::new(pass, compiled, channels, draw, &formats, &states);
        done.compiled.camera = geometry.map(|g| g.camera);
        done.meshes = meshes;
        for ((drafted, compiled), kind) in done.fills.iter_mut().zip(fills).zip(FillKind::ALL) {
            let (Some(compiled), Some(fill)) = (compiled, pass.fill(kind)) else { continue };
            let mut channels: [BoundChannel; 4] = Default::default();
            let texels = fill.value.path().and_then(|path| media.fill(path));
            if let Some(texels) = texels {
                let used = compiled.reflection.channels[0];
                channels[0] = binder.bind_fill(&mut self.uploads, texels, used)?;
            }
            let draw = draw.of_fill(texels.is_some());
            let draft = DrawDraft::new(pass, compiled, channels, &draw, &formats[..1], &[]);
            *drafted = Some((Box::new(draft), draw));
        }
        Ok(done)
    }
}

/// The passes that can be drawn, compiled; the project with only these, and every warning.
struct Compilation {
    drawable: Project,
    passes: Vec<CompiledParts>,
    diagnostics: Vec<Diagnostic>,
}

/// A compiled pass, its fills in the order of [`FillKind::ALL`], and how its channels mix texels.
struct CompiledParts {
    compiled: CompiledPass,
    fills: [Option<CompiledPass>; 2],
    mixing: [Mixing; 4],
}

/// A draw that waits for its pipelines.
struct DrawDraft {
    compiled: CompiledDraw,
    orders: Vec<PipelineOrder>,
    programs: usize,
    meshes: Vec<PlacedMesh>,
    fills: [Option<(Box<DrawDraft>, Draw)>; 2],
}

impl DrawDraft {
    fn new(
        pass: &Pass,
        compiled: CompiledPass,
        channels: [BoundChannel; 4],
        draw: &Draw,
        formats: &[PassFormat],
        states: &[MeshState],
    ) -> Self {
        let CompiledPass { programs, reflection, .. } = compiled;
        let channel_group = channel_bindings(&channels, draw);
        let orders: Vec<PipelineOrder> = programs
            .into_iter()
            .enumerate()
            .map(|(n, program)| {
                let mut uniforms = vec![(0, Binding::Uniform { bytes: size_of::<interface::UniformBlock>() as u64 })];
                for (number, bytes) in program.tables() {
                    let uniform = Binding::Uniform { bytes: bytes.len() as u64 };
                    let is_storage = number == interface::TABLE_BINDING;
                    uniforms.push((number, if is_storage { Binding::Storage } else { uniform }));
                }
                if !reflection.knobs.is_empty() {
                    uniforms.push((interface::KNOB_BINDING, Binding::Uniform { bytes: program.knob_bytes() }));
                }
                if reflection.geometry {
                    let bytes = size_of::<interface::GeometryBlock>() as u64;
                    uniforms.push((interface::GEOMETRY_BINDING, Binding::Uniform { bytes }));
                }
                PipelineOrder {
                    label: pass.id.title(),
                    program,
                    groups: [uniforms, channel_group.clone()],
                    formats: formats.to_vec(),
                    mesh: states.get(n).copied(),
                }
            })
            .collect();
        let compiled = CompiledDraw {
            id: pass.id.clone(),
            programs: Vec::new(),
            camera: None,
            first_mesh: 0,
            reads_geometry: reflection.geometry,
            channels,
            initial: None,
            boundary: None,
            uniforms: reflection.uniforms,
            knobs: reflection.knobs,
        };
        Self { compiled, programs: orders.len(), orders, meshes: Vec::new(), fills: [None, None] }
    }

    /// Gives the orders of the pass, then those of its fills.
    fn take_orders(&mut self) -> Vec<PipelineOrder> {
        let mut orders = std::mem::take(&mut self.orders);
        for (fill, _) in self.fills.iter_mut().flatten() {
            orders.extend(fill.take_orders());
        }
        orders
    }

    /// Takes a pipeline for each of its orders.
    fn finish(self, made: &mut impl Iterator<Item = Arc<StagePipeline>>) -> CompiledDraw {
        let Self { mut compiled, programs, meshes, fills, .. } = self;
        let mut meshes = meshes.into_iter();
        compiled.programs =
            made.by_ref().take(programs).map(|pipeline| DrawProgram { pipeline, mesh: meshes.next() }).collect();
        let [initial, boundary] = fills
            .map(|fill| fill.map(|(draft, draw)| Box::new(FillProgram { compiled: draft.finish(&mut *made), draw })));
        CompiledDraw { initial, boundary, ..compiled }
    }
}

/// Returns what the device's driver needs of the code of a pass.
fn driver(gpu: &Gpu, pass: &Pass) -> Driver {
    let has_small_floats = pass.settings.formats().into_iter().any(PassFormat::is_small_float);
    Driver {
        tables_in_memory: !gpu.has_storage_buffers,
        opaque_uniforms: gpu.recompiles_for_uniforms,
        may_discard: gpu.keeps_denormals && has_small_floats,
        nan_angle: gpu.nan_angle,
        array_loops: gpu.wants_array_loops,
        loop_closing_exits: gpu.keeps_loops_open,
        hidden_limits: gpu.misjudges_limits,
    }
}

/// A cubemap pass is not drawn, so a channel that reads it is as one whose file is missing.
fn without_cubemap_passes(mut pass: Pass) -> Pass {
    for channel in pass.channels.iter_mut().flatten() {
        if channel.input == Input::CubemapPass {
            channel.input = Input::Cubemap(Media::Builtin("cube_a".into()));
        }
    }
    pass
}

fn facts(compiled: &CompiledPass) -> PassFacts {
    PassFacts {
        channels: compiled.reflection.channels.map(|c| ChannelFacts { is_read: c.is_read(), reaches_mips: c.mips }),
        discards: compiled.reflection.discards,
    }
}
