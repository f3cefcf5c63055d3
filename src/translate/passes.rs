//! Compiles and plans a project, and writes each of its stages in the target language.

use std::collections::HashSet;

use eddy_diag::{self as diag, Diagnostic, SourceId, SourceMap};
use eddy_engine::{CompiledPass, CompiledProgram, Sources};
use eddy_glsl::{ClipSpace, Compiled, PassSource, PlainOptions, interface};
use eddy_graph::{Draw, FramePlan, PassFacts, Read, ReadTiming, Target, TexelSource};
use eddy_project::{
    Channel, CustomUniformValue, FillKind, Filter, Input, Media, Pass, PassName, PassSize, Project, Side, Tab, Wrap,
};
use eddy_texture::Dimension;

use crate::{
    File, Language, MANIFEST, Translation, bindings,
    manifest::*,
    refusals::{self, PassTexts},
    write,
};

type Result<T> = std::result::Result<T, Vec<Diagnostic>>;

/// The value of [`Manifest::format`].
const FORMAT: &str = "eddy-translation";

/// The corners are at (-1, -1), (3, -1) and (-1, 3), before a writer negates y.
const FULL_SCREEN: &str = "#version 300 es
void main() { gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
";

/// Compiles, plans and writes.
pub(crate) fn translate(project: &Project, language: Language) -> Result<Translation> {
    let texts = Sources::new(project);
    let mut found = texts.diagnostics.clone();
    let (mut pictures, mut sounds) = (Compilation::of(project), Compilation::of(project));
    for (index, pass) in project.passes.iter().enumerate() {
        let outcome = texts.compile_pass(index, language.driver());
        let fills = FillKind::ALL.map(|kind| texts.compile_fill(index, kind, false, language.driver()));
        let to = if pass.id.is_picture() { &mut pictures } else { &mut sounds };
        let mut kept: [Option<CompiledPass>; 2] = [None, None];
        for (kept, fill) in kept.iter_mut().zip(fills) {
            match fill {
                Some(Ok(mut fill)) => {
                    diag::append(&mut found, fill.diagnostics.drain(..));
                    *kept = Some(fill);
                }
                Some(Err(errors)) => diag::append(&mut found, errors),
                None => {}
            }
        }
        match outcome {
            Ok(mut compiled) => {
                diag::append(&mut found, compiled.diagnostics.drain(..));
                to.facts.push(compiled.facts());
                to.project.passes.push(if pass.id.is_picture() { pass.clone() } else { with_sound_channels(pass) });
                to.passes.push((index, compiled, kept));
            }
            Err(errors) => diag::append(&mut found, errors),
        }
    }
    if found.iter().any(Diagnostic::is_error) {
        return Err(found);
    }
    let sources = project.sources();
    let mut writer = Writer { project, language, sources: &sources, files: Vec::new(), refused: Vec::new() };
    let full_screen = writer.full_screen();
    let plan = FramePlan::new(&pictures.project, &pictures.facts, &[], true);
    let mut manifest = Manifest {
        format: FORMAT,
        version: VERSION,
        eddy: env!("CARGO_PKG_VERSION"),
        project: project.name.clone(),
        language: language.key(),
        language_version: language.version(),
        full_screen,
        custom_uniforms: custom_uniforms(&texts, project),
        targets: plan.targets.iter().map(target).collect(),
        runs: runs(&plan, &pictures.project),
        passes: Vec::new(),
        skipped: plan.skipped.iter().map(|&pass| pictures.project.passes[pass].id.key().to_owned()).collect(),
    };
    manifest.passes.extend(writer.passes(&plan, &pictures, 0));
    if !sounds.passes.is_empty() {
        let plan = FramePlan::new(&sounds.project, &sounds.facts, &[PassName::sound()], true);
        let before = manifest.targets.len();
        manifest.targets.extend(plan.targets.iter().map(target));
        manifest.passes.extend(writer.passes(&plan, &sounds, before));
    }
    let Writer { mut files, refused, .. } = writer;
    if !refused.is_empty() {
        return Err(found.into_iter().chain(refused).collect());
    }
    let mut text = serde_json::to_vec_pretty(&manifest).expect("a manifest has texts for keys");
    text.push(b'\n');
    files.push(File { name: MANIFEST.into(), bytes: text });
    Ok(Translation { files, manifest, diagnostics: found })
}

/// The passes that compiled, with the project reduced to them.
struct Compilation {
    project: Project,
    facts: Vec<PassFacts>,
    /// The index in the whole project, the pass and its fills.
    passes: Vec<(usize, CompiledPass, [Option<CompiledPass>; 2])>,
}

impl Compilation {
    fn of(project: &Project) -> Self {
        let mut project = project.clone();
        project.passes.clear();
        Self { project, facts: Vec::new(), passes: Vec::new() }
    }
}

/// Returns the sound pass with only the channels that it can read.
fn with_sound_channels(pass: &Pass) -> Pass {
    let mut pass = pass.clone();
    pass.bindings.retain(|channel| channel.input.kind().is_in_sound());
    pass
}

/// Collects files and refusals.
struct Writer<'a> {
    project: &'a Project,
    language: Language,
    sources: &'a SourceMap,
    files: Vec<File>,
    refused: Vec<Diagnostic>,
}

impl<'a> Writer<'a> {
    fn full_screen(&mut self) -> EntryPoint {
        let plain = PlainOptions { group: 0, clip_space: ClipSpace::UNCHANGED };
        let compiled = eddy_glsl::compile(&PassSource { plain, ..PassSource::vertex(FULL_SCREEN) });
        let compiled = compiled.expect("Eddy's own vertex shader compiles");
        let title = "The full-screen triangle".to_owned();
        let place = PassTexts { title, sources: self.sources, texts: Vec::new() };
        let info = self.stage("full_screen", (&compiled, None), &place);
        info.map_or(EntryPoint { file: String::new(), entry_point: String::new() }, |stage| stage.entry)
    }

    /// Writes the draws of a plan. Its targets are numbered from `first_target`.
    fn passes(&mut self, plan: &FramePlan, compiled: &Compilation, first_target: usize) -> Vec<PassInfo> {
        plan.draws.iter().map(|draw| self.pass(draw, compiled, first_target)).collect()
    }

    fn pass(&mut self, draw: &Draw, all: &Compilation, first_target: usize) -> PassInfo {
        let pass = &all.project.passes[draw.pass];
        let (index, compiled, fills) = &all.passes[draw.pass];
        let key = pass.id.key();
        let place = self.place(*index, pass);
        let programs = compiled.programs().iter().enumerate().map(|(n, program)| {
            let stem = if pass.body.is_screen() { key.to_owned() } else { format!("{key}.{n}") };
            let mesh = pass.body.draws().get(n).map(|draw| MeshInfo {
                mesh: draw.mesh.name(),
                cull: draw.cull.name(),
                front_face: self.language.front_face(),
                depth: draw.depth.name(),
                depth_write: draw.depth_write,
                color_write: draw.color_write,
                scale: draw.scale,
                rotation: draw.rotation,
                position: draw.position,
            });
            ProgramInfo { mesh, ..self.program(&stem, program, &place) }
        });
        let programs = programs.collect();
        let reads = draw.reads.iter().enumerate().filter_map(|(channel, read)| Some((channel, read.as_ref()?)));
        let channels = reads.map(|(n, read)| channel(n, read, pass.bindings.get(n), first_target)).collect();
        let mut filled = Vec::new();
        for (kind, fill) in FillKind::ALL.into_iter().zip(fills) {
            let (Some(compiled), Some(own)) = (fill, pass.fill(kind)) else { continue };
            let (name, width) = match kind {
                FillKind::Initial => ("initial", None),
                FillKind::Boundary => ("boundary", pass.settings.boundary.as_ref().map(|b| b.width)),
            };
            let Some(program) = compiled.programs().first() else { continue };
            filled.push(FillInfo {
                fill: name,
                width,
                file: own.value.path().map(file_name),
                program: self.program(&format!("{key}.{name}"), program, &place),
            });
        }
        let camera = pass.body.geometry().map(|geometry| geometry.camera).map(|c| CameraInfo {
            yaw: c.yaw,
            pitch: c.pitch,
            distance: c.distance,
            target: c.target,
            fov: c.fov,
            near: c.near,
            far: c.far,
        });
        PassInfo {
            title: pass.id.title(),
            targets: draw.targets.clone().map(|target| first_target + target).collect(),
            keeps_content: draw.keeps_content,
            when: draw.when.as_ref().map(ToString::to_string),
            region: draw.region.map(|r| RegionInfo { x: r.x, y: r.y, width: r.width, height: r.height }),
            camera,
            channels,
            programs,
            fills: filled,
            pass: key.to_owned(),
        }
    }

    /// Returns the places of a pass's texts: its own, those of its stages, Common, and all others.
    fn place(&self, index: usize, pass: &Pass) -> PassTexts<'a> {
        let own = pass.body.drawn_stages().into_iter().map(|stage| self.project.stage_id(index, stage));
        let all = (0..=u16::MAX).map(SourceId).take_while(|id| self.sources.get(*id).is_some());
        let included = all.filter(|id| matches!(self.project.tab_of(*id), Some(Tab::Included(_))));
        let mut seen = HashSet::new();
        let texts = own.chain([Project::COMMON_ID]).chain(included).filter(|id| seen.insert(*id)).collect();
        PassTexts { title: pass.id.title(), sources: self.sources, texts }
    }

    fn program(&mut self, stem: &str, program: &CompiledProgram, place: &PassTexts<'_>) -> ProgramInfo {
        let vertex = program.vertex.as_ref().map(|vertex| (&**vertex, Some(&*program.fragment)));
        let stages = vertex.into_iter().chain([(&*program.fragment, None)]);
        ProgramInfo { stages: stages.filter_map(|stage| self.stage(stem, stage, place)).collect(), mesh: None }
    }

    /// Writes a stage; `None` if it was refused.
    fn stage(
        &mut self,
        stem: &str,
        (compiled, next): (&Compiled, Option<&Compiled>),
        place: &PassTexts<'_>,
    ) -> Option<StageInfo> {
        let language = self.language;
        let is_vertex = compiled.module.entry_points[0].stage == eddy_glsl::naga::ShaderStage::Vertex;
        let (stage, suffix) = if is_vertex { ("vertex", "vert") } else { ("fragment", "frag") };
        let refused = refusals::of_module(&compiled.module, language, place);
        let written = match refused {
            Some(refused) => Err(refused),
            None => write::write(&compiled.module, next.map(|next| &next.module), language)
                .map_err(|reason| refusals::of_writer(language, place, &reason)),
        };
        let written = match written {
            Ok(written) => written,
            Err(refused) => {
                if !self.refused.contains(&refused) {
                    self.refused.push(refused);
                }
                return None;
            }
        };
        let mut bindings = Vec::new();
        for (variable, binding) in bindings::resources(&written.module) {
            let table = match binding.binding {
                _ if binding.group != interface::UNIFORM_GROUP => None,
                interface::TABLE_BINDING => Some(&compiled.tables),
                interface::UNIFORM_TABLE_BINDING | interface::VERTEX_TABLE_BINDING => Some(&compiled.uniform_tables),
                _ => None,
            };
            let contents = table.filter(|bytes| !bytes.is_empty()).map(|bytes| {
                let name = format!("{stem}.{suffix}.{}.bin", variable.name.as_deref().unwrap_or("table"));
                self.files.push(File { name: name.clone(), bytes: bytes.clone() });
                name
            });
            let glsl = written.glsl_names.get(&binding).map(String::as_str);
            bindings.extend(bindings::info(&written.module, (variable, binding), language, glsl, contents));
        }
        let attributes = compiled.reflection.attributes.iter().map(|attribute| VertexInput {
            name: attribute.name(),
            location: attribute.location(),
            components: attribute.components(),
        });
        let file = format!("{stem}.{suffix}.{}", language.extension());
        self.files.push(File { name: file.clone(), bytes: written.bytes });
        let entry = EntryPoint { file, entry_point: written.entry_point };
        Some(StageInfo { stage, entry, bindings, attributes: attributes.collect() })
    }
}

fn custom_uniforms(texts: &Sources<'_>, project: &Project) -> Vec<CustomUniformInfo> {
    let info = |(slot, uniform): (usize, &eddy_project::CustomUniform)| CustomUniformInfo {
        name: uniform.name.clone(),
        ty: uniform.ty.name(),
        offset: slot as u32 * interface::CUSTOM_UNIFORM_BYTES as u32,
        value: match uniform.value(&project.custom_uniform_values) {
            CustomUniformValue::Bool(on) => vec![f64::from(u8::from(on))],
            CustomUniformValue::Int(n) => vec![f64::from(n)],
            CustomUniformValue::Float(x) => vec![x],
            CustomUniformValue::Vector(all) => all,
            CustomUniformValue::List(_) => Vec::new(),
        },
        meaning: None,
    };
    let own = &texts.custom_uniforms().list;
    let of_host = |(n, uniform): (usize, &eddy_project::HostUniform)| CustomUniformInfo {
        name: uniform.name.to_owned(),
        ty: uniform.ty.name(),
        offset: (own.len() + n) as u32 * interface::CUSTOM_UNIFORM_BYTES as u32,
        value: vec![0.0; uniform.ty.components()],
        meaning: Some(uniform.value.about()),
    };
    let host = project.dialect.row().uniforms.iter().enumerate().filter(|(_, uniform)| uniform.value.has_slot());
    own.iter().enumerate().map(info).chain(host.map(of_host)).collect()
}

fn target(target: &Target) -> TargetInfo {
    TargetInfo {
        pass: target.id.key().to_owned(),
        index: target.index,
        dimension: dimension(target.dimension),
        size: match target.size {
            PassSize::Canvas => SizeInfo::Canvas { canvas: 1.0 },
            PassSize::Scale(by) => SizeInfo::Canvas { canvas: by },
            PassSize::Fixed(width, height) => SizeInfo::Fixed { width, height },
            PassSize::Sides(width, height) => {
                let side = |side| match side {
                    Side::Scale(canvas) => SideInfo::Canvas { canvas },
                    Side::Floor(floor) => SideInfo::Floor { floor },
                    Side::Fixed(texels) => SideInfo::Fixed { texels },
                };
                SizeInfo::Sides { width: side(width), height: side(height) }
            }
        },
        format: target.format.name(),
        doubled: target.doubled,
        mips: target.mips,
    }
}

fn dimension(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::D2 => "2d",
        Dimension::D3 => "3d",
        Dimension::Cube => "cube",
    }
}

fn runs(plan: &FramePlan, project: &Project) -> Vec<RunInfo> {
    let key = |draw: &Draw| project.passes[draw.pass].id.key().to_owned();
    let run = |run: &eddy_graph::Run| RunInfo {
        passes: plan.draws[run.draws.clone()].iter().map(key).collect(),
        steps: run.steps,
    };
    plan.runs.iter().map(run).collect()
}

fn channel(number: usize, read: &Read, own: Option<&Channel>, first_target: usize) -> ChannelInfo {
    let from = match read.source {
        TexelSource::Target { index, when } => ReadFrom::Target {
            target: first_target + index,
            frame: match when {
                ReadTiming::ThisFrame => "this",
                ReadTiming::LastFrame => "last",
            },
        },
        TexelSource::External => own.map_or(ReadFrom::Nothing, |channel| ReadFrom::External {
            kind: channel.input.row().key,
            name: match &channel.input {
                Input::Media { media, .. } => Some(media_name(media)),
                Input::Pass { .. } | Input::Device(_) => None,
            },
        }),
        TexelSource::Nothing => ReadFrom::Nothing,
    };
    let filter = match read.sampler.filter {
        Filter::Nearest => "nearest",
        Filter::Mipmap if read.mips => "mipmap",
        // Without mip levels, or if no read uses them, both are the same.
        Filter::Linear | Filter::Mipmap => "linear",
    };
    let wrap = match read.sampler.wrap {
        Wrap::Clamp => "clamp",
        Wrap::Repeat => "repeat",
    };
    ChannelInfo { channel: number, from, filter, wrap, vflip: read.sampler.vflip }
}

/// Returns the name of a file or texture without its folders.
fn media_name(media: &Media) -> String {
    match media {
        Media::Builtin(name) => name.clone(),
        Media::File(path) => path.to_string_lossy().replace('\\', "/"),
        Media::Picked(path) => file_name(path),
        Media::Site { path, id } => if path.is_empty() { id } else { path }.clone(),
    }
}

fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
