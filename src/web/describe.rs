//! Builds the player's description of a project: the draws, their order, and their inputs.

use crate::{
    data::{
        CameraData, ChannelData, DrawData, FillData, PassData, ProjectData, RunData, SideData, SizeData, UniformData,
    },
    inline::Inlined,
    texts::Texts,
};
use eddy_diag::SourceId;
use eddy_engine::{CompiledPass, Sources, channel_kinds};
use eddy_glsl::{ChannelKind, taken};
use eddy_graph::{FramePlan, PassFacts, effective_sampler};
use eddy_project::{
    CustomUniform, CustomUniformRange, FillKind, Filter, Input, InputKind, Media, PassSize, Project, Sampler, Side,
    Stage, Term, Wrap,
};
use serde_json::Value;
use std::collections::BTreeSet;

/// Describes a project whose passes compile.
pub(crate) fn describe(
    project: &Project,
    (sources, compiled): (&Sources<'_>, &[CompiledPass]),
    inlined: &mut Inlined<'_>,
) -> ProjectData {
    let facts: Vec<PassFacts> = compiled.iter().map(CompiledPass::facts).collect();
    let plan = FramePlan::new(project, &facts, &[], true);
    let mut texts = Texts::new(project, sources);
    let description = Description { project, sources, facts: &facts, plan: &plan };
    let shared = description.uniforms([Project::COMMON_ID]);
    let passes = (0..project.passes.len()).map(|index| description.pass(index, &mut texts, inlined)).collect();
    let run = |run: &eddy_graph::Run| RunData {
        passes: plan.draws[run.draws.clone()].iter().map(|draw| draw.pass).collect(),
        steps: run.steps,
    };
    let custom = &sources.custom_uniforms().list;
    let others = project.custom_uniform_values.iter().filter(|(name, _)| !custom.iter().any(|one| one.name == **name));
    ProjectData {
        name: project.name.clone(),
        author: project.info.author.clone(),
        description: project.info.description.clone(),
        uniforms: custom.iter().map(|uniform| uniform_data(uniform, project)).collect(),
        values: others.map(|(name, value)| (name.clone(), value.components())).collect(),
        shared,
        passes,
        runs: plan.runs.iter().map(run).collect(),
        media: std::mem::take(&mut inlined.list),
        meshes: std::mem::take(&mut inlined.meshes),
        texts: texts.names,
        codes: texts.codes,
    }
}

struct Description<'a> {
    project: &'a Project,
    sources: &'a Sources<'a>,
    facts: &'a [PassFacts],
    plan: &'a FramePlan,
}

impl Description<'_> {
    fn pass(&self, index: usize, texts: &mut Texts<'_>, inlined: &mut Inlined<'_>) -> PassData {
        let pass = &self.project.passes[index];
        let draw = self.plan.draws.iter().find(|draw| draw.pass == index);
        let targets = draw.map_or(&[][..], |draw| &self.plan.targets[draw.targets.clone()]);
        let is_target = pass.id.is_readable();
        let skip = draw.is_none() && pass.id.is_picture();
        let geometry = pass.body.geometry();
        let stages: BTreeSet<SourceId> =
            pass.body.drawn_stages().into_iter().map(|stage| self.project.stage_id(index, stage)).collect();
        let draws = geometry.filter(|_| !skip).map(|geometry| {
            let mut code = |stage: Stage| texts.code(self.project.stage_id(index, stage));
            let draw = |draw: &eddy_project::MeshDraw| {
                Some(DrawData {
                    mesh: inlined.mesh(draw)?,
                    vertex: code(draw.vertex),
                    fragment: code(draw.fragment),
                    cull: draw.cull.name(),
                    depth: draw.depth.name(),
                    depth_write: draw.depth_write,
                    color_write: draw.color_write,
                    scale: draw.scale,
                    rotation: draw.rotation,
                    position: draw.position,
                })
            };
            geometry.draws.iter().filter_map(draw).collect()
        });
        let camera = geometry.map(|geometry| geometry.camera).map(|c| CameraData {
            yaw: c.yaw,
            pitch: c.pitch,
            distance: c.distance,
            target: c.target,
            fov: c.fov,
            near: c.near,
            far: c.far,
            orbit: c.orbit,
        });
        let is_screen = pass.body.is_screen();
        PassData {
            title: pass.id.title(),
            kind: pass.id.row().json_type,
            skip,
            size: match pass.size() {
                PassSize::Canvas => SizeData::Canvas(1.0),
                PassSize::Scale(by) => SizeData::Canvas(by),
                PassSize::Fixed(width, height) => SizeData::Fixed([width, height]),
                PassSize::Sides(width, height) => SizeData::Sides([width, height].map(|side| match side {
                    Side::Scale(by) | Side::Floor(by) => SideData::Canvas(by.to_string()),
                    Side::Fixed(texels) => SideData::Fixed(texels),
                })),
            },
            formats: if is_target { pass.formats().iter().map(|format| format.name()).collect() } else { Vec::new() },
            mips: if is_target { targets.iter().map(|target| target.mips).collect() } else { Vec::new() },
            doubled: targets.iter().any(|target| target.doubled),
            cached: is_target && is_screen && draw.is_some_and(|draw| draw.is_cacheable),
            region: pass.settings.region.map(|r| [r.x, r.y, r.width, r.height]),
            when: pass.settings.when.as_ref().map(|when| term(when.root())),
            initial: self.fill(index, FillKind::Initial, texts, inlined),
            boundary: self.fill(index, FillKind::Boundary, texts, inlined),
            code: (is_screen && !skip).then(|| texts.code(Project::pass_id(index))),
            draws,
            camera,
            channels: std::array::from_fn(|channel| self.channel(index, channel, inlined)),
            uniforms: self.uniforms(stages.into_iter().chain([Project::COMMON_ID])),
        }
    }

    fn fill(&self, index: usize, kind: FillKind, texts: &mut Texts<'_>, inlined: &mut Inlined<'_>) -> Option<FillData> {
        let pass = &self.project.passes[index];
        let fill = pass.fill(kind)?;
        Some(FillData {
            width: pass.settings.boundary.as_ref().filter(|_| kind == FillKind::Boundary).map(|b| b.width),
            code: texts.fill(index, kind, &fill.value),
            m: match fill.value.path() {
                Some(path) => Some(inlined.fill(path)?),
                None => None,
            },
        })
    }

    fn channel(&self, index: usize, number: usize, inlined: &mut Inlined<'_>) -> Option<ChannelData> {
        let pass = &self.project.passes[index];
        let channel = pass.bindings.get(number)?;
        let sampler = effective_sampler(self.project, index, number).unwrap_or(Sampler::BUFFER);
        let is_heard = pass.id.is_picture() || channel.input.kind().is_in_sound();
        let (from, of_pass, of_media) = match &channel.input {
            _ if !is_heard => ("none", None, None),
            Input::Pass { id, target } => match self.project.passes.iter().position(|pass| pass.id == *id) {
                Some(at) if *target < self.project.passes[at].formats().len() => ("pass", Some((at, *target)), None),
                None if id.is_buffer() => ("zero", None, None),
                _ => ("none", None, None),
            },
            Input::Device(kind) => (kind.row().key, None, None),
            Input::Media { kind, .. } => {
                let place = format!("iChannel{number} of {}", pass.id.title());
                match (inlined.channel(channel, &place), kind) {
                    (Some(at), _) => ("media", None, Some(at)),
                    (None, InputKind::Music) => match channel.input.media() {
                        Some(Media::Site { .. } | Media::Builtin(_)) => ("synthetic", None, None),
                        _ => ("silence", None, None),
                    },
                    (None, _) => ("none", None, None),
                }
            }
        };
        Some(ChannelData {
            from,
            pass: of_pass.map(|(at, _)| at),
            target: of_pass.map(|(_, target)| target),
            m: of_media,
            filter: match sampler.filter {
                Filter::Nearest => "nearest",
                Filter::Linear => "linear",
                Filter::Mipmap => "mipmap",
            },
            wrap: match sampler.wrap {
                Wrap::Clamp => "clamp",
                Wrap::Repeat => "repeat",
            },
            dim: match channel_kinds(pass)[number] {
                ChannelKind::Sampler1D | ChannelKind::Sampler2D => None,
                ChannelKind::Sampler3D => Some("3d"),
                ChannelKind::SamplerCube => Some("cube"),
            },
            flip: sampler.vflip && channel.input.row().has_vflip,
            read: self.facts[index].channels[number].is_read,
        })
    }

    /// Returns the indices of the uniforms declared by `#iUniform` lines of these texts and of their included texts.
    fn uniforms(&self, of: impl IntoIterator<Item = SourceId>) -> Vec<usize> {
        let texts: BTreeSet<SourceId> = of.into_iter().flat_map(|id| self.sources.include_lines().reach(id)).collect();
        let is_there = |uniform: &CustomUniform| {
            uniform.declared_in.iter().any(|id| texts.contains(id)) && taken(&uniform.name).is_none()
        };
        let all = self.sources.custom_uniforms().list.iter().enumerate();
        all.filter(|(_, uniform)| is_there(uniform)).map(|(at, _)| at).collect()
    }
}

/// Returns a term as JSON: an operation is a list of its symbol or name and its terms.
fn term(term: &Term) -> Value {
    let operation = |name: &str, parts: &[Term]| {
        Value::from([Value::from(name)].into_iter().chain(parts.iter().map(self::term)).collect::<Vec<_>>())
    };
    match term {
        Term::Number(number) => Value::from(*number),
        Term::Name(name) => Value::from(name.as_str()),
        Term::Not(of) => Value::from(vec!["!".into(), self::term(of)]),
        Term::Negative(of) => Value::from(vec!["-".into(), self::term(of)]),
        Term::Pair(operator, a, b) => Value::from(vec![operator.symbol.into(), self::term(a), self::term(b)]),
        // A condition has neither, and the player knows neither.
        Term::Choice(parts) => operation("?", parts.as_ref()),
        Term::Call(function, arguments) => operation(function.name, arguments),
    }
}

fn uniform_data(uniform: &CustomUniform, project: &Project) -> UniformData {
    let n = uniform.ty.components();
    let part = |all: [f64; 4]| all[..n].to_vec();
    let range: Option<CustomUniformRange> = uniform.range;
    UniformData {
        name: uniform.name.clone(),
        ty: uniform.ty.name(),
        value: uniform.value(&project.custom_uniform_values).components(),
        min: range.map(|range| part(range.min)),
        max: range.map(|range| part(range.max)),
        step: uniform.step.map(part),
        about: uniform.about.clone(),
        group: uniform.group.clone(),
    }
}
