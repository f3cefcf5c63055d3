//! From a project to everything a frame needs that does not change from frame to frame.

use super::{
    EngineError, Sources,
    fill::{self, FillProgram},
    geometry::{self, MeshUploads, PlacedMesh},
    stages::{CompiledPass, CompiledProgram, shader},
    targets::texture_format,
};
use crate::{
    diag::{self, Diagnostic, SourceMap},
    glsl::{ChannelKind, Driver, KnobSet, UniformSet, interface},
    gpu::{
        Binding, FragmentPipelineDescriptor, Gpu, MipMaker, Pipeline, Texture, TextureDescriptor, constant_buffer,
        mip_levels,
    },
    graph::{ChannelFacts, Draw, FramePlan, PassFacts, Source},
    media::{MediaKey, MediaSet, TexelFormat, Texels},
    project::{
        Camera, Channel, FillKind, Filter, Geometry, Input, Knob, KnobValues, PassFormat, PassId, PassSettings,
        PassSize, Project,
    },
};
use std::{collections::HashMap, sync::Arc};

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

/// A whole set of compiled passes and their plan. Made on any thread; swapped in at once by [`super::Engine::set_program`].
pub struct Program {
    pub(super) plan: FramePlan,
    /// One for each of the plan's draws.
    pub(super) draws: Vec<CompiledDraw>,
    /// The author's own uniforms, in the order of their slots.
    pub(super) knobs: Vec<Knob>,
    /// As they stand when the program is taken up.
    pub(super) knob_values: KnobValues,
}

/// The pipelines of one draw and what its channels are bound to.
pub(super) struct CompiledDraw {
    pub id: PassId,
    /// One, or one for each mesh the pass draws.
    pub programs: Vec<DrawProgram>,
    /// Where meshes are drawn.
    pub camera: Option<Camera>,
    /// Place of its first mesh among those of all draws.
    pub first_mesh: usize,
    /// Some program reads what meshes are drawn with.
    pub reads_geometry: bool,
    pub channels: [BoundChannel; 4],
    /// What its target holds before frame 0, and what its outermost texels are overwritten with.
    pub initial: Option<Box<FillProgram>>,
    pub boundary: Option<Box<FillProgram>>,
    /// The uniforms that are read: the site's, and the author's own by their slots.
    pub uniforms: UniformSet,
    pub knobs: KnobSet,
}

/// One program of a draw.
pub(super) struct DrawProgram {
    pub pipeline: Pipeline,
    /// The constant tables of its stages, where they have any, by their bindings.
    pub tables: Vec<(u32, wgpu::Buffer)>,
    /// `None`: the triangle over the whole target.
    pub mesh: Option<PlacedMesh>,
}

/// One channel of a compiled pass.
#[derive(Default)]
pub(super) struct BoundChannel {
    pub kind: ChannelKind,
    pub texture: bool,
    pub sampler: bool,
    /// The sampler may filter: the texture's format can be filtered on this device.
    pub filters: bool,
    /// The picture, where the channel reads one and it is there.
    pub media: Option<Texture>,
    /// What `iChannelResolution` says of the channel if it does not read a buffer.
    pub resolution: [f32; 3],
    /// The size of the buffer the channel names, if it names one.
    pub buffer: Option<PassSize>,
}

/// A program and what the compiler wants to say of it.
pub struct Built {
    pub program: Program,
    /// Warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
    pub sources: SourceMap,
}

/// Why there is no program.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// The author's to mend: at least one error, all of all passes.
    #[error("the project does not compile")]
    Diagnostics { diagnostics: Vec<Diagnostic>, sources: SourceMap },
    #[error(transparent)]
    Engine(#[from] EngineError),
}

impl Program {
    /// Compiles every pass, plans the frame and makes the pipelines of the passes it needs. `media` holds the pictures the
    /// channels name; one that is missing reads as the site's unloaded channel.
    pub fn build(gpu: &Gpu, project: &Project, media: &MediaSet, options: &BuildOptions) -> Result<Built, BuildError> {
        let sources = project.sources();
        let texts = Sources::new(project);
        let (drawable, compiled, diagnostics) = match compile(gpu, project, &texts, media) {
            Ok(done) => done,
            Err(diagnostics) => return Err(BuildError::Diagnostics { diagnostics, sources }),
        };
        let facts: Vec<PassFacts> = compiled.iter().map(|(own, _)| facts(own)).collect();
        for id in &options.wanted {
            if drawable.pass(id).is_none() {
                return Err(EngineError::NoSuchPass(id.title()).into());
            }
        }
        let plan = FramePlan::new(&drawable, &facts, &options.wanted, options.skip);
        let mut compiled: Vec<Option<_>> = compiled.into_iter().map(Some).collect();
        let mut uploads = Uploads { gpu, mips: MipMaker::new(gpu), made: HashMap::new() };
        let mut meshes = MeshUploads::new(gpu, media);
        let mut jobs = Vec::new();
        for draw in &plan.draws {
            let pass = &drawable.passes[draw.pass];
            let Some((compiled, fills)) = compiled[draw.pass].take() else { continue };
            let mut channels: [BoundChannel; 4] = Default::default();
            for (index, bound) in channels.iter_mut().enumerate() {
                let used = compiled.reflection.channels[index];
                let channel = pass.channels[index].as_ref();
                (bound.texture, bound.sampler) = (used.texture, used.sampler);
                bound.kind = kind_of(channel);
                let texels = channel.and_then(media_key).and_then(|key| media.get(&key).map(|t| (key, t)));
                let float = is_float(&drawable, channel, texels.as_ref().map(|(_, t)| &***t));
                let read = draw.reads[index].as_ref();
                bound.filters =
                    read.is_some_and(|r| r.sampler.filter != Filter::Nearest) && (!float || gpu.filters_float32);
                bound.resolution = match channel.map(|c| &c.input) {
                    Some(Input::Keyboard) => [256.0, 3.0, 1.0],
                    _ => texels.as_ref().map_or([0.0; 3], |(_, t)| [t.width as f32, t.height as f32, 1.0]),
                };
                bound.buffer = channel.and_then(|c| settings_of(&drawable, c)).map(|s| s.size);
                if let Some((key, texels)) = texels
                    && (used.texture || used.sampler)
                {
                    let mips = read.is_some_and(|r| r.mips);
                    bound.media = Some(uploads.get(key, texels, mips).map_err(EngineError::from)?);
                }
            }
            let geometry = pass.settings.geometry.as_ref();
            let meshes = geometry.map_or(Ok(Vec::new()), |g| meshes.placed(g))?;
            let formats: Vec<PassFormat> = plan.targets[draw.targets.clone()].iter().map(|t| t.format).collect();
            let mut fill_jobs = [None, None];
            for ((job, compiled), kind) in fill_jobs.iter_mut().zip(fills).zip(FillKind::ALL) {
                let (Some(compiled), Some(fill)) = (compiled, pass.fill(kind)) else { continue };
                let mut channels: [BoundChannel; 4] = Default::default();
                let mut is_picture = false;
                if let Some(path) = fill.value.path()
                    && let Some(texels) = media.fill(path)
                {
                    let used = compiled.reflection.channels[0];
                    (channels[0].texture, channels[0].sampler, is_picture) = (used.texture, used.sampler, true);
                    channels[0].filters = texels.format != TexelFormat::Rgba32Float || gpu.filters_float32;
                    channels[0].resolution = [texels.width as f32, texels.height as f32, 1.0];
                    let key = MediaKey::of_fill(path);
                    channels[0].media = Some(uploads.get(key, texels, false).map_err(EngineError::from)?);
                }
                let draw = fill::draw_of(draw, is_picture);
                *job = Some(FillJob { id: pass.id.clone(), compiled, channels, draw, format: formats[0] });
            }
            let own = PassJob { id: pass.id.clone(), compiled, channels, draw, formats, geometry, meshes };
            jobs.push(Job { own, fills: fill_jobs });
        }
        let mut draws = make_pipelines(gpu, jobs)?;
        let mut first_mesh = 0;
        for draw in draws.iter_mut().filter(|d| d.camera.is_some()) {
            draw.first_mesh = first_mesh;
            first_mesh += draw.programs.len();
        }
        let program =
            Program { plan, draws, knobs: texts.knobs().list.clone(), knob_values: project.knob_values.clone() };
        Ok(Built { program, diagnostics, sources })
    }

    /// The author's own uniforms, in the order they are declared.
    pub fn knobs(&self) -> &[Knob] {
        &self.knobs
    }

    /// Meshes that are drawn, all passes together.
    pub(super) fn meshes(&self) -> usize {
        self.draws.iter().filter(|d| d.camera.is_some()).map(|d| d.programs.len()).sum()
    }

    /// What is drawn, read and kept in each frame.
    pub fn plan(&self) -> &FramePlan {
        &self.plan
    }
}

/// The passes that can be drawn, compiled; `project` with only these, and every warning.
type Compilation = (Project, Vec<(CompiledPass, CompiledFills)>, Vec<Diagnostic>);

/// Of a pass, in the order of [`FillKind::ALL`].
type CompiledFills = [Option<CompiledPass>; 2];

fn compile(
    gpu: &Gpu,
    project: &Project,
    texts: &Sources<'_>,
    media: &MediaSet,
) -> Result<Compilation, Vec<Diagnostic>> {
    let mut drawable = project.clone();
    drawable.passes.clear();
    let mut compiled = Vec::new();
    let mut diagnostics: Vec<Diagnostic> = texts.diagnostics.clone();
    diagnostics.extend(media.mesh_errors(project));
    diagnostics.extend(media.fill_errors(project));
    for (index, pass) in project.passes.iter().enumerate() {
        if matches!(pass.id, PassId::Cubemap | PassId::Sound) {
            let what = pass.id.title();
            diagnostics
                .push(Diagnostic::warning(None, format!("the pass {what} is not drawn; what reads it reads black")));
            continue;
        }
        let bilinear_by_hand = std::array::from_fn(|i| {
            let channel = pass.channels[i].as_ref();
            let texels = channel.and_then(media_key).and_then(|k| media.get(&k));
            let filter = crate::graph::effective_sampler(project, index, i).map(|s| s.filter);
            !gpu.filters_float32
                && is_float(project, channel, texels.map(|t| &**t))
                && filter.is_some_and(|f| f != Filter::Nearest)
        });
        let has_small_floats = pass.settings.formats().into_iter().any(PassFormat::is_small_float);
        let driver = Driver {
            tables_in_memory: !gpu.has_storage_buffers,
            opaque_uniforms: gpu.recompiles_for_uniforms,
            may_discard: gpu.keeps_denormals && has_small_floats,
            nan_angle: gpu.nan_angle,
            array_loops: gpu.wants_array_loops,
            loop_closing_exits: gpu.keeps_loops_open,
            hidden_limits: gpu.misjudges_limits,
        };
        let mut fills: CompiledFills = [None, None];
        let mut said = Vec::new();
        for (done, kind) in fills.iter_mut().zip(FillKind::ALL) {
            // A picture of floats is filtered by hand where a device cannot.
            match texts.compile_fill(index, kind, !gpu.filters_float32, driver) {
                None => {}
                Some(Ok(mut fill)) => {
                    said.append(&mut fill.diagnostics);
                    *done = Some(fill);
                }
                Some(Err(errors)) => said.extend(errors),
            }
        }
        match texts.compile_pass(index, bilinear_by_hand, driver) {
            Ok(mut done) => {
                said.append(&mut done.diagnostics);
                drawable.passes.push(without_cubemap_passes(pass.clone()));
                compiled.push((done, fills));
            }
            Err(errors) => said.extend(errors),
        }
        diag::append(&mut diagnostics, said);
    }
    if diagnostics.iter().any(Diagnostic::is_error) { Err(diagnostics) } else { Ok((drawable, compiled, diagnostics)) }
}

/// A cubemap pass is not drawn, so a channel that reads it is as one whose file is missing.
fn without_cubemap_passes(mut pass: crate::project::Pass) -> crate::project::Pass {
    for channel in pass.channels.iter_mut().flatten() {
        if channel.input == Input::CubemapPass {
            channel.input = Input::Cubemap(crate::project::Media::Builtin("cube_a".into()));
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

pub(super) fn kind_of(channel: Option<&Channel>) -> ChannelKind {
    match channel.map(|c| &c.input) {
        Some(Input::Cubemap(_) | Input::CubemapPass) => ChannelKind::SamplerCube,
        Some(Input::Volume(_)) => ChannelKind::Sampler3D,
        _ => ChannelKind::Sampler2D,
    }
}

fn media_key(channel: &Channel) -> Option<MediaKey> {
    match &channel.input {
        Input::Texture(media) => Some(MediaKey { media: media.clone(), vflip: channel.sampler.vflip }),
        _ => None,
    }
}

/// How the buffer is drawn that the channel names, if it names one.
fn settings_of(project: &Project, channel: &Channel) -> Option<PassSettings> {
    let (name, index) = channel.input.buffer()?;
    let mut settings = project.pass(&PassId::Buffer(name.to_owned())).map(|p| p.settings.clone()).unwrap_or_default();
    settings.format = settings.formats().get(index).copied().unwrap_or_default();
    Some(settings)
}

/// Whether what the channel reads holds 32-bit floats.
fn is_float(project: &Project, channel: Option<&Channel>, texels: Option<&Texels>) -> bool {
    channel.and_then(|c| settings_of(project, c)).is_some_and(|s| s.format.is_32_bit())
        || texels.is_some_and(|t| t.format == TexelFormat::Rgba32Float)
}

/// Pictures on the device, each once.
struct Uploads<'a> {
    gpu: &'a Gpu,
    mips: MipMaker,
    made: HashMap<(MediaKey, bool), Texture>,
}

impl Uploads<'_> {
    fn get(&mut self, key: MediaKey, texels: &Arc<Texels>, mips: bool) -> Result<Texture, crate::gpu::GpuError> {
        let key = (key, mips);
        if let Some(texture) = self.made.get(&key) {
            return Ok(texture.clone());
        }
        let (width, height) = (texels.width, texels.height);
        let texture = Texture::new(
            self.gpu,
            &TextureDescriptor {
                label: "picture",
                width,
                height,
                format: match texels.format {
                    TexelFormat::R8 => wgpu::TextureFormat::R8Unorm,
                    TexelFormat::Rgba8 => wgpu::TextureFormat::Rgba8Unorm,
                    TexelFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
                },
                levels: if mips { mip_levels(width, height) } else { 1 },
                is_target: false,
            },
        )?;
        texture.write(self.gpu, &texels.bytes);
        if mips {
            let chain = self.mips.chain(self.gpu, &texture);
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            self.mips.build(self.gpu, &mut encoder, &chain);
            self.gpu.queue.submit([encoder.finish()]);
        }
        self.made.insert(key, texture.clone());
        Ok(texture)
    }
}

/// What the pipelines of a pass and its fills are made of.
struct Job<'a> {
    own: PassJob<'a>,
    fills: [Option<FillJob>; 2],
}

struct FillJob {
    id: PassId,
    compiled: CompiledPass,
    channels: [BoundChannel; 4],
    draw: Draw,
    format: PassFormat,
}

struct PassJob<'a> {
    id: PassId,
    compiled: CompiledPass,
    channels: [BoundChannel; 4],
    draw: &'a Draw,
    formats: Vec<PassFormat>,
    geometry: Option<&'a Geometry>,
    /// One for each of its draws.
    meshes: Vec<PlacedMesh>,
}

/// Pipelines side by side: a driver takes a tenth of a second for one.
fn make_pipelines(gpu: &Gpu, jobs: Vec<Job<'_>>) -> Result<Vec<CompiledDraw>, EngineError> {
    let make = |job: Job<'_>| job.make(gpu);
    if jobs.len() == 1 {
        return jobs.into_iter().map(make).collect();
    }
    std::thread::scope(|scope| {
        let threads: Vec<_> = jobs.into_iter().map(|job| scope.spawn(move || make(job))).collect();
        threads.into_iter().map(|t| t.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    })
}

impl Job<'_> {
    fn make(self, gpu: &Gpu) -> Result<CompiledDraw, EngineError> {
        let mut made = self.own.make(gpu)?;
        let [initial, boundary] = self.fills.map(|fill| fill.map(|job| job.make(gpu)).transpose());
        (made.initial, made.boundary) = (initial?.map(Box::new), boundary?.map(Box::new));
        Ok(made)
    }
}

impl FillJob {
    fn make(self, gpu: &Gpu) -> Result<FillProgram, EngineError> {
        let FillJob { id, compiled, channels, draw, format } = self;
        let job =
            PassJob { id, compiled, channels, draw: &draw, formats: vec![format], geometry: None, meshes: Vec::new() };
        let compiled = job.make(gpu)?;
        Ok(FillProgram { compiled, draw })
    }
}

impl PassJob<'_> {
    fn make(self, gpu: &Gpu) -> Result<CompiledDraw, EngineError> {
        let PassJob { id, compiled, channels, draw, formats, geometry, meshes } = self;
        let CompiledPass { programs, reflection, .. } = compiled;
        let reads_geometry = reflection.geometry;
        let channel_group = channel_bindings(&channels, draw);
        let label = id.title();
        let groups = |program: &CompiledProgram| {
            let mut uniforms = vec![(0, Binding::Uniform { bytes: size_of::<interface::UniformBlock>() as u64 })];
            for (number, bytes) in program.tables() {
                let uniform = Binding::Uniform { bytes: bytes.len() as u64 };
                uniforms.push((number, if number == interface::TABLE_BINDING { Binding::Storage } else { uniform }));
            }
            if !reflection.knobs.is_empty() {
                uniforms.push((interface::KNOB_BINDING, Binding::Uniform { bytes: program.knob_bytes() }));
            }
            if reads_geometry {
                let bytes = size_of::<interface::GeometryBlock>() as u64;
                uniforms.push((interface::GEOMETRY_BINDING, Binding::Uniform { bytes }));
            }
            [uniforms, channel_group.clone()]
        };
        let mut meshes = meshes.into_iter();
        let mut made = Vec::with_capacity(programs.len());
        for program in programs {
            let groups = groups(&program);
            let table = |(number, bytes): (u32, &[u8])| {
                let is_storage = number == interface::TABLE_BINDING;
                let usage = if is_storage { wgpu::BufferUsages::STORAGE } else { wgpu::BufferUsages::UNIFORM };
                Ok((number, constant_buffer(gpu, "constant tables", usage, bytes)?))
            };
            let tables = program.tables().map(table).collect::<Result<Vec<_>, crate::gpu::GpuError>>()?;
            made.push(match meshes.next() {
                Some(mesh) => geometry::program(gpu, &label, program, mesh, &formats, &groups, tables)?,
                None => {
                    let descriptor = FragmentPipelineDescriptor {
                        label: &label,
                        shader: shader(program.fragment),
                        entry_point: interface::ENTRY_POINT,
                        groups: &groups,
                        target: texture_format(formats[0]),
                    };
                    DrawProgram { pipeline: Pipeline::new(gpu, descriptor)?, tables, mesh: None }
                }
            });
        }
        Ok(CompiledDraw {
            id,
            programs: made,
            camera: geometry.map(|g| g.camera),
            first_mesh: 0,
            reads_geometry,
            channels,
            initial: None,
            boundary: None,
            uniforms: reflection.uniforms,
            knobs: reflection.knobs,
        })
    }
}

fn channel_bindings(channels: &[BoundChannel; 4], draw: &Draw) -> Vec<(u32, Binding)> {
    let mut bindings = Vec::new();
    for (index, channel) in channels.iter().enumerate() {
        let dimension = match channel.kind {
            ChannelKind::Sampler2D => wgpu::TextureViewDimension::D2,
            ChannelKind::Sampler3D => wgpu::TextureViewDimension::D3,
            ChannelKind::SamplerCube => wgpu::TextureViewDimension::Cube,
        };
        // An empty channel is an 8-bit texture and can always be filtered; it is bound like the others to need no third case.
        let filterable =
            channel.filters && !matches!(draw.reads[index].as_ref().map(|r| &r.source), Some(Source::Keyboard));
        if channel.texture {
            bindings.push((interface::texture_binding(index), Binding::Texture { dimension, filterable }));
        }
        if channel.sampler {
            bindings.push((interface::sampler_binding(index), Binding::Sampler { filtering: filterable }));
        }
    }
    bindings
}
