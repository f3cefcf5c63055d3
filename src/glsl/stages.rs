//! The two stages of a program that draws meshes, and their interface.
//!
//! Contains the names of attributes, the locations of the `in` and `out` variables of a stage, and the rules for
//! matching stages (section 4.3.9 of the GLSL ES 3.00 specification, where violations are link errors).

use super::{
    ChannelKind, PassKind, PassSource,
    ast::{Interner, Origins},
    hir::{Global, GlobalId, GlobalStorage, Module, SamplerDim, Scalar, Type, TypeId},
    interface,
    ir::Texture,
    near::nearest_identifier,
    plain::{self, Resources, ShaderVariable},
};
use eddy_diag::Diagnostic;

/// The number of four-component slots between the stages that every device supports.
const MAX_SLOTS: u32 = 15;

/// The number of vertex attributes that every device supports (`gl_MaxVertexAttribs`).
const MAX_ATTRIBUTES: u32 = 16;

/// The attributes of a vertex. A stage declares those it reads, with these names and types: `in vec3 aPosition;`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Attribute {
    Position,
    Normal,
    Tangent,
    Uv,
    Color,
}

impl Attribute {
    /// All attributes, in the order of their locations.
    pub const ALL: [Attribute; 5] =
        [Attribute::Position, Attribute::Normal, Attribute::Tangent, Attribute::Uv, Attribute::Color];

    /// Returns the name in GLSL.
    pub fn name(self) -> &'static str {
        match self {
            Attribute::Position => "aPosition",
            Attribute::Normal => "aNormal",
            Attribute::Tangent => "aTangent",
            Attribute::Uv => "aUv",
            Attribute::Color => "aColor",
        }
    }

    /// Returns the number of floats. The fourth component of the tangent is the sign by which the bitangent
    /// `cross(normal, tangent)` is multiplied.
    pub fn components(self) -> u8 {
        match self {
            Attribute::Position | Attribute::Normal => 3,
            Attribute::Tangent | Attribute::Color => 4,
            Attribute::Uv => 2,
        }
    }

    pub fn location(self) -> u32 {
        self as u32
    }
}

/// An output of a vertex stage: an `out` there, an `in` of the same name and type in the fragment stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varying {
    pub name: String,
    /// The type in GLSL.
    pub ty: String,
    pub flat: bool,
    /// The location of its first slot.
    pub location: u32,
}

/// The information that a stage needs about the rest of the program.
#[derive(Clone, Copy, Debug, Default)]
pub struct Link<'a> {
    /// The outputs of the vertex stage; `None` if unknown, for example while that stage has errors.
    pub varyings: Option<&'a [Varying]>,
    /// The number of targets that the fragment stage draws into; `None` if unknown.
    pub targets: Option<usize>,
}

/// The `in` and `out` variables of a stage, each with the location of its first slot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interface {
    pub inputs: Vec<(GlobalId, u32)>,
    pub outputs: Vec<(GlobalId, u32)>,
    pub varyings: Vec<Varying>,
    /// The uniforms and samplers of a plain shader; for other passes, the channels.
    pub resources: Resources,
    /// The inputs and outputs of a plain shader for users of the crate, in the order of `inputs` and `outputs`.
    pub variables: [Vec<ShaderVariable>; 2],
}

/// Assigns the locations of a stage's interface, and reports errors in it. Passes that are not stages have none.
pub(crate) fn interface(
    module: &Module,
    names: &Interner,
    origins: &Origins,
    source: &PassSource<'_>,
    link: &Link<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Interface {
    let is_plain = source.kind.is_plain();
    let is_main = matches!(source.kind, PassKind::Main(_));
    let mut linker =
        Linker { module, names, origins, link, is_plain, is_main, diagnostics, made: Interface::default() };
    let of = |storage: GlobalStorage| {
        let all = module.globals.iter().enumerate().filter(move |(_, g)| g.storage == storage && g.ty != TypeId::ERROR);
        all.map(|(i, _)| GlobalId::new(i)).collect::<Vec<_>>()
    };
    match source.kind {
        PassKind::PlainVertex => {
            linker.located(&of(GlobalStorage::In), MAX_ATTRIBUTES);
            linker.outputs_of_vertices(&of(GlobalStorage::Out));
        }
        PassKind::Vertex => {
            of(GlobalStorage::In).into_iter().for_each(|id| linker.attribute(id));
            linker.outputs_of_vertices(&of(GlobalStorage::Out));
        }
        PassKind::Fragment | PassKind::PlainFragment => {
            linker.inputs_of_fragments(&of(GlobalStorage::In));
            linker.colours(&of(GlobalStorage::Out));
        }
        PassKind::Main(_) => linker.colours(&of(GlobalStorage::Out)),
        PassKind::Image | PassKind::Buffer | PassKind::Cubemap | PassKind::Sound => {}
    }
    let mut made = linker.made;
    if source.kind.is_plain() {
        made.resources = plain::resources(module, names, source.plain);
        let tell =
            |all: &[(GlobalId, u32)]| all.iter().map(|&(id, at)| plain::variable(module, names, id, at)).collect();
        made.variables = [tell(&made.inputs), tell(&made.outputs)];
    } else {
        made.resources.textures = channels(source);
    }
    made
}

/// Returns the textures of the channels.
fn channels(source: &PassSource<'_>) -> Vec<Texture> {
    let texture = |(i, kind): (usize, ChannelKind)| Texture {
        name: String::new(),
        dim: match kind {
            ChannelKind::Sampler1D | ChannelKind::Sampler2D => SamplerDim::D2,
            ChannelKind::Sampler3D => SamplerDim::D3,
            ChannelKind::SamplerCube => SamplerDim::Cube,
        },
        scalar: Scalar::Float,
        shadow: false,
        group: interface::CHANNEL_GROUP,
        binding: interface::texture_binding(i),
    };
    source.channels.into_iter().enumerate().map(texture).collect()
}

/// Returns the slots that a value takes, in order, each a scalar or vector; `None` for types that cannot pass between
/// stages.
pub(crate) fn slots(module: &Module, ty: TypeId) -> Option<Vec<TypeId>> {
    match module.types.get(ty) {
        Type::Scalar(Scalar::Bool) | Type::Vector { scalar: Scalar::Bool, .. } => None,
        Type::Scalar(_) | Type::Vector { .. } => Some(vec![ty]),
        Type::Matrix { columns, rows } => Some(vec![TypeId::vector(Scalar::Float, rows); usize::from(columns)]),
        Type::Array { element, len } => {
            let one = slots(module, element)?;
            // More slots than are available are reported later, so not all need be listed.
            let count = (len as usize).min(MAX_SLOTS as usize + 1);
            Some(one.iter().copied().cycle().take(one.len() * count).collect())
        }
        Type::Struct(_) | Type::Sampler { .. } | Type::Void | Type::Error => None,
    }
}

struct Linker<'a> {
    module: &'a Module,
    names: &'a Interner,
    origins: &'a Origins,
    link: &'a Link<'a>,
    is_plain: bool,
    is_main: bool,
    diagnostics: &'a mut Vec<Diagnostic>,
    made: Interface,
}

impl Linker<'_> {
    fn name(&self, global: &Global) -> &str {
        self.names.get(global.name.symbol)
    }

    fn error(&mut self, global: &Global, message: String, hint: impl Into<String>) {
        let diagnostic = self.origins.error(self.names, global.name, message).hint(hint);
        self.diagnostics.push(diagnostic);
    }

    fn attribute(&mut self, id: GlobalId) {
        let global = self.module[id];
        let name = self.name(&global);
        let Some(attribute) = Attribute::ALL.into_iter().find(|a| a.name() == name) else {
            let known = Attribute::ALL.map(Attribute::name);
            let hint = match nearest_identifier(name, known) {
                Some(near) => format!("did you mean `{near}`?"),
                None => {
                    let all = Attribute::ALL.map(|a| format!("vec{} {}", a.components(), a.name()));
                    format!("the attributes are {}", all.join(", "))
                }
            };
            let message = format!("a vertex has no attribute `{name}`");
            return self.error(&global, message, hint);
        };
        if global.ty != TypeId::vector(Scalar::Float, attribute.components()) {
            let message = format!("the attribute `{name}` is a `vec{}`", attribute.components());
            let hint = format!("write `in vec{} {name};`", attribute.components());
            return self.error(&global, message, hint);
        }
        self.made.inputs.push((id, attribute.location()));
    }

    /// Assigns to attributes of any name their explicit locations, and to the others the first free ones.
    fn located(&mut self, all: &[GlobalId], count: u32) {
        let mut taken: Vec<(std::ops::Range<u32>, GlobalId)> = Vec::new();
        let (said, free): (Vec<_>, Vec<_>) = all.iter().partition(|id| self.module[**id].location.is_some());
        for &id in said.into_iter().chain(free) {
            let global = self.module[id];
            let name = self.name(&global).to_owned();
            // The checker rejects arrays of attributes.
            let Some(size) = slots(self.module, global.ty).map(|slots| slots.len() as u32) else { continue };
            let overlapping = |from: u32| taken.iter().find(|(other, _)| from < other.end && other.start < from + size);
            let location = match global.location {
                Some(location) => location,
                None => {
                    let mut from = 0;
                    while let Some((other, _)) = overlapping(from) {
                        from = other.end;
                    }
                    from
                }
            };
            if let Some(&(_, other)) = overlapping(location) {
                let other = self.name(&self.module[other]).to_owned();
                let message = format!("`{name}` and `{other}` both have location {location}");
                self.error(&global, message, "give each its own location; a matrix takes one for each column");
                continue;
            }
            if location.saturating_add(size) > count {
                let message = format!("there is no room for `{name}`: the locations are 0 to {}", count - 1);
                self.error(&global, message, "choose a lower location, or declare fewer inputs");
                continue;
            }
            taken.push((location..location + size, id));
            self.made.inputs.push((id, location));
        }
    }

    fn outputs_of_vertices(&mut self, all: &[GlobalId]) {
        let mut next = 0;
        for &id in all {
            let global = self.module[id];
            let Some(slots) = slots(self.module, global.ty) else {
                let message = format!("`{}` cannot be passed between stages", self.name(&global));
                self.error(&global, message, "pass numbers, vectors, matrices or arrays of them");
                continue;
            };
            if next + slots.len() as u32 > MAX_SLOTS {
                let message = format!("there is no room for `{}`", self.name(&global));
                let hint =
                    format!("the limit is {MAX_SLOTS} slots of up to four components; a matrix takes one per column");
                return self.error(&global, message, hint);
            }
            let name = self.name(&global).to_owned();
            let ty = self.module.type_text(self.names, global.ty);
            self.made.varyings.push(Varying { name, ty, flat: global.flat, location: next });
            self.made.outputs.push((id, next));
            next += slots.len() as u32;
        }
    }

    fn inputs_of_fragments(&mut self, all: &[GlobalId]) {
        let mut next = 0;
        for &id in all {
            let global = self.module[id];
            let name = self.name(&global).to_owned();
            let Some(slots) = slots(self.module, global.ty) else {
                self.error(
                    &global,
                    format!("`{name}` cannot be handed from stage to stage"),
                    "pass numbers, vectors, matrices or arrays of them",
                );
                continue;
            };
            let Some(varyings) = self.link.varyings else {
                // Any location will do: a program without a vertex stage is never drawn.
                self.made.inputs.push((id, next));
                next += slots.len() as u32;
                continue;
            };
            let ty = self.module.type_text(self.names, global.ty);
            let (message, hint) = match varyings.iter().find(|v| v.name == name) {
                Some(v) if v.ty != ty => (
                    format!("`{name}` is a `{ty}` here and a `{}` in the vertex stage", v.ty),
                    "declare both the same way".to_owned(),
                ),
                Some(v) if v.flat != global.flat => {
                    let with = if v.flat { "`flat`" } else { "not `flat`" };
                    (format!("`{name}` is {with} in the vertex stage"), "declare both the same way".to_owned())
                }
                Some(v) => {
                    self.made.inputs.push((id, v.location));
                    continue;
                }
                None => {
                    let known = varyings.iter().map(|v| v.name.as_str());
                    let hint = match nearest_identifier(&name, known) {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => format!("declare `out {ty} {name};` there and set it"),
                    };
                    (format!("the vertex stage has no output `{name}`"), hint)
                }
            };
            self.error(&global, message, hint);
        }
    }

    fn colours(&mut self, all: &[GlobalId]) {
        let mut taken: Vec<(u32, GlobalId)> = Vec::new();
        for &id in all {
            let global = self.module[id];
            let name = self.name(&global).to_owned();
            let is_float = matches!(
                self.module.types.get(global.ty),
                Type::Scalar(Scalar::Float) | Type::Vector { scalar: Scalar::Float, .. }
            );
            let is_number = matches!(
                self.module.types.get(global.ty),
                Type::Scalar(Scalar::Int | Scalar::Uint) | Type::Vector { scalar: Scalar::Int | Scalar::Uint, .. }
            );
            if self.is_plain && !is_float && !is_number {
                let ty = self.module.type_text(self.names, global.ty);
                let message = format!("the output `{name}` cannot be a `{ty}`");
                self.error(&global, message, "declare one vector for each target");
                continue;
            }
            if !is_float && !self.is_plain {
                self.error(&global, format!("targets hold floats, so `{name}` cannot be written"), "make it a `vec4`");
                continue;
            }
            let location = match global.location {
                Some(location) => location,
                // Hosts that draw one target leave the locations to the driver, which assigns them in text order.
                None if all.len() == 1 || self.is_main => taken.len() as u32,
                None => {
                    let hint = format!("write `layout(location = 0) out vec4 {name};`, with a number for each");
                    self.error(&global, format!("with several outputs, `{name}` needs a target number"), hint);
                    continue;
                }
            };
            if let Some((_, other)) = taken.iter().find(|(l, _)| *l == location) {
                let other = self.name(&self.module[*other]).to_owned();
                let message = format!("`{name}` and `{other}` both write target {location}");
                self.error(&global, message, "give each its own location");
                continue;
            }
            if let Some(targets) = self.link.targets.filter(|t| location as usize >= *t) {
                let message = format!("`{name}` writes target {location}, but the pass has {targets}");
                let hint = match self.is_plain {
                    true => "choose another location",
                    false => "add a format to the pass's `targets` in eddy.toml, or choose another location",
                };
                self.error(&global, message, hint);
                continue;
            }
            if location as usize >= super::interface::MAX_TARGETS {
                let message = format!("there is no target {location}");
                self.error(&global, message, "a pass has targets 0 to 3 at most");
                continue;
            }
            taken.push((location, id));
            self.made.outputs.push((id, location));
        }
    }
}
