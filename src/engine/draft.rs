//! A draw before its pipelines exist: its inputs are on the device, and its pipelines are specified.

use super::{
    EngineError,
    channels::{ChannelBinder, channel_bindings},
    compiled::{CompiledPass, CompiledProgram},
    mesh_instance::MeshInstance,
    pipelines::{MeshState, PipelineOrder, StagePipeline},
    program::{BoundChannel, CompiledDraw, DrawBody, FillProgram, FilterMode, Meshes},
};
use eddy_glsl::{MAX_CHANNELS, Reflection, interface, opt::specialise::Specialisable};
use eddy_gpu::Binding;
use eddy_graph::{Draw, FramePlan};
use eddy_project::{Body, Camera, FillKind, Pass};
use eddy_texture::{Dimension, TexelFormat};
use std::sync::Arc;

/// A compiled pass, its fills in the order of [`FillKind::ALL`], and the filtering of its channels.
pub(super) struct CompiledParts {
    pub compiled: CompiledPass,
    pub fills: [Option<CompiledPass>; 2],
    pub filter_mode: [FilterMode; MAX_CHANNELS],
    /// The declared dimensions of its channels.
    pub dimensions: [Dimension; MAX_CHANNELS],
}

/// A draw that waits for its pipelines.
pub(super) struct DrawDraft {
    program: ProgramDraft,
    fills: [Option<(ProgramDraft, Draw)>; 2],
}

impl DrawDraft {
    /// Uploads the inputs of a draw, and determines the pipelines that it needs.
    pub(crate) fn new(
        binder: &mut ChannelBinder<'_>,
        plan: &FramePlan,
        draw: &Draw,
        parts: CompiledParts,
    ) -> Result<Self, EngineError> {
        let pass = &binder.project.passes[draw.pass];
        let CompiledParts { compiled, fills, filter_mode, dimensions } = parts;
        let mut channels: [BoundChannel; MAX_CHANNELS] = Default::default();
        for (index, bound) in channels.iter_mut().enumerate() {
            let mips = draw.reads[index].as_ref().is_some_and(|r| r.mips);
            let (channel, used) = (pass.bindings.get(index), compiled.reflection.channels[index]);
            *bound = binder.bind((channel, dimensions[index]), used, filter_mode[index], mips)?;
        }
        let body = match &pass.body {
            Body::Screen => BodyDraft::Screen,
            Body::Meshes(geometry) => BodyDraft::Meshes {
                camera: geometry.camera,
                states: geometry.draws.iter().map(MeshState::of).collect(),
                placed: binder.uploads.placed(binder.gpu, binder.media, geometry)?,
            },
        };
        let formats: Vec<TexelFormat> = draw.all_targets().map(|target| plan.targets[target].format).collect();
        let program = ProgramDraft::new(pass, compiled, channels, &formats, body);
        let mut drafted = [None, None];
        for ((drafted, compiled), kind) in drafted.iter_mut().zip(fills).zip(FillKind::ALL) {
            let (Some(compiled), Some(fill)) = (compiled, pass.fill(kind)) else { continue };
            let mut channels: [BoundChannel; MAX_CHANNELS] = Default::default();
            let picture = fill.value.path().and_then(|path| Some((path, binder.media.fill(path)?)));
            if let Some((path, texels)) = picture {
                channels[0] = binder.bind_fill(path, texels, compiled.reflection.channels[0])?;
            }
            let draw = draw.of_fill(picture.is_some());
            // Boundaries are drawn with the pass. The contents before frame 0 are drawn into the pass's first target
            // only.
            let formats = if kind == FillKind::Boundary { &formats[..] } else { &formats[..1] };
            let program = ProgramDraft::new(pass, compiled, channels, formats, BodyDraft::Screen);
            *drafted = Some((program, draw));
        }
        Ok(Self { program, fills: drafted })
    }

    /// Returns the orders of the pass, then those of its fills.
    pub(crate) fn take_orders(&mut self) -> Vec<PipelineOrder> {
        let fills = self.fills.iter_mut().flatten().map(|(program, _)| program);
        [&mut self.program].into_iter().chain(fills).flat_map(|program| std::mem::take(&mut program.orders)).collect()
    }

    /// Takes a pipeline for each of its orders from `made`, and appends its meshes to those of the previous draws.
    pub(crate) fn finish(
        self,
        made: &mut impl Iterator<Item = Arc<StagePipeline>>,
        meshes: &mut usize,
    ) -> CompiledDraw {
        let compiled = self.program.finish(made, meshes);
        let [initial, boundary] = self.fills.map(|fill| {
            fill.map(|(program, draw)| Box::new(FillProgram { compiled: program.finish(&mut *made, meshes), draw }))
        });
        CompiledDraw { initial, boundary, ..compiled }
    }
}

/// The triangle or the meshes that a program draws.
enum BodyDraft {
    Screen,
    Meshes { camera: Camera, states: Vec<MeshState>, placed: Vec<MeshInstance> },
}

/// The programs of a pass or of one of its fills.
struct ProgramDraft {
    pass: eddy_project::PassName,
    reflection: Reflection,
    specialisable: Vec<Specialisable>,
    channels: [BoundChannel; MAX_CHANNELS],
    body: BodyDraft,
    orders: Vec<PipelineOrder>,
}

impl ProgramDraft {
    fn new(
        pass: &Pass,
        compiled: CompiledPass,
        channels: [BoundChannel; MAX_CHANNELS],
        formats: &[TexelFormat],
        body: BodyDraft,
    ) -> Self {
        let CompiledPass { programs, reflection, .. } = compiled;
        let channel_group = channel_bindings(&channels);
        let stages = programs.iter().flat_map(CompiledProgram::stages);
        let specialisable =
            stages.map(|stage| stage.specialisable.clone()).collect::<Option<Vec<_>>>().unwrap_or_default();
        let order = |(n, program): (usize, CompiledProgram)| PipelineOrder {
            label: pass.id.title(),
            groups: [uniform_bindings(&program, &reflection), channel_group.clone()],
            formats: formats.to_vec(),
            mesh: match &body {
                BodyDraft::Screen => None,
                BodyDraft::Meshes { states, .. } => states.get(n).copied(),
            },
            program,
        };
        let orders = programs.into_iter().enumerate().map(order).collect();
        Self { pass: pass.id.clone(), orders, reflection, specialisable, channels, body }
    }

    fn finish(self, made: &mut impl Iterator<Item = Arc<StagePipeline>>, meshes: &mut usize) -> CompiledDraw {
        let Self { pass, reflection, specialisable, channels, body, .. } = self;
        let mut next = || made.next().expect("a pipeline was made for each order");
        CompiledDraw {
            id: pass,
            body: match body {
                BodyDraft::Screen => DrawBody::Screen(next()),
                BodyDraft::Meshes { camera, placed, .. } => {
                    let first = *meshes;
                    *meshes += placed.len();
                    let programs = placed.into_iter().map(|mesh| (next(), mesh)).collect();
                    DrawBody::Meshes(Meshes { camera, first, programs })
                }
            },
            reads_geometry: reflection.geometry,
            channels,
            initial: None,
            boundary: None,
            uniforms: reflection.uniforms,
            custom_uniforms: reflection.custom_uniforms,
            specialisable,
        }
    }
}

/// Returns the bind group layout of a program's uniforms.
pub(super) fn uniform_bindings(program: &CompiledProgram, reflection: &Reflection) -> Vec<(u32, Binding)> {
    let mut bindings = vec![(0, Binding::Uniform { bytes: size_of::<interface::UniformBlock>() as u64 })];
    for (number, bytes) in program.tables() {
        let uniform = Binding::Uniform { bytes: bytes.len() as u64 };
        let is_storage = number == interface::TABLE_BINDING;
        bindings.push((number, if is_storage { Binding::Storage } else { uniform }));
    }
    if !reflection.custom_uniforms.is_empty() {
        bindings.push((interface::CUSTOM_UNIFORM_BINDING, Binding::Uniform { bytes: program.custom_uniform_bytes() }));
    }
    if reflection.geometry {
        let bytes = size_of::<interface::GeometryBlock>() as u64;
        bindings.push((interface::GEOMETRY_BINDING, Binding::Uniform { bytes }));
    }
    bindings
}
