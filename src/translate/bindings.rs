//! The resources of a stage, their members, and their binding numbers in each language.

use eddy_glsl::{interface, naga};
use naga::{
    AddressSpace, ArraySize, GlobalVariable, ImageDimension, ResourceBinding, ScalarKind, Type, TypeInner, UniqueArena,
};
use serde::Serialize;

use crate::{GlslVersion, Language};

/// A resource that a stage declares.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BindingInfo {
    pub kind: BindingKind,
    /// The name in the text, if the language preserves it.
    pub name: String,
    pub at: BindingSlot,
    /// The size of a buffer in bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<u32>,
    /// Members of a buffer, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<Member>,
    /// The file with the contents of a constant buffer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contents: Option<String>,
    /// The channel of a texture or sampler: 0 to 3, for `iChannel0` to `iChannel3`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub channel: Option<u32>,
    /// The dimension of a texture: `2d`, `3d` or `cube`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dimension: Option<&'static str>,
}

/// The content of a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BindingKind {
    /// The uniforms of Shadertoy.
    Uniforms,
    /// The custom uniforms, 16 bytes each.
    CustomUniforms,
    /// The matrices of a mesh and the camera.
    Geometry,
    /// A uniform buffer with constants of the program.
    UniformTable,
    /// A read-only storage buffer with constants of the program.
    StorageTable,
    Texture,
    Sampler,
}

impl BindingKind {
    fn of(binding: ResourceBinding) -> Option<Self> {
        Some(match (binding.group, binding.binding) {
            (interface::UNIFORM_GROUP, 0) => BindingKind::Uniforms,
            (interface::UNIFORM_GROUP, interface::TABLE_BINDING) => BindingKind::StorageTable,
            (interface::UNIFORM_GROUP, interface::UNIFORM_TABLE_BINDING | interface::VERTEX_TABLE_BINDING) => {
                BindingKind::UniformTable
            }
            (interface::UNIFORM_GROUP, interface::CUSTOM_UNIFORM_BINDING) => BindingKind::CustomUniforms,
            (interface::UNIFORM_GROUP, interface::GEOMETRY_BINDING) => BindingKind::Geometry,
            (interface::CHANNEL_GROUP, number) if number % 2 == 0 => BindingKind::Texture,
            (interface::CHANNEL_GROUP, _) => BindingKind::Sampler,
            _ => return None,
        })
    }
}

/// The binding of a resource in the terms of the language.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum BindingSlot {
    Wgsl {
        group: u32,
        binding: u32,
    },
    /// In register space 0: `b0`, `t0`, `s0`.
    Hlsl {
        register: String,
    },
    Msl(MslSlot),
    /// The name of a uniform block, of a buffer block or of a sampler. Before GLSL 4.2 it is bound by that name.
    Glsl {
        name: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        binding: Option<u32>,
    },
    Spirv {
        set: u32,
        binding: u32,
    },
}

/// An index into one of Metal's argument tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MslSlot {
    Buffer(u8),
    Texture(u8),
    Sampler(u8),
}

/// A member of a buffer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Member {
    pub name: String,
    /// The GLSL spelling: `vec3`, `mat4`, `vec4[4]`.
    #[serde(rename = "type")]
    pub ty: String,
    /// In bytes from the start of the buffer.
    pub offset: u32,
}

/// Returns the channel whose texture or sampler has a binding.
pub(crate) fn channel(binding: ResourceBinding) -> Option<u32> {
    (binding.group == interface::CHANNEL_GROUP).then_some(binding.binding / 2)
}

/// Returns the number of a resource where buffers, textures and samplers are numbered separately. Storage buffers
/// follow the textures, because Direct3D numbers both together.
pub(crate) fn slot(binding: ResourceBinding) -> u32 {
    match (channel(binding), BindingKind::of(binding)) {
        (Some(channel), _) => channel,
        (None, Some(BindingKind::StorageTable)) => 4,
        // Avoids the storage buffer where all buffers are numbered together.
        (None, Some(BindingKind::Geometry)) => 1,
        (None, _) => binding.binding,
    }
}

/// Returns the variables of a module that have a binding, ordered by binding.
pub(crate) fn resources(module: &naga::Module) -> Vec<(&GlobalVariable, ResourceBinding)> {
    let bound = module.global_variables.iter().filter_map(|(_, variable)| Some((variable, variable.binding?)));
    let mut all: Vec<_> = bound.collect();
    all.sort_by_key(|(_, binding)| (binding.group, binding.binding));
    all
}

/// Returns the description of a resource for a program; `None` for a sampler in GLSL, which is combined with its
/// texture. `glsl` is the name that naga gave to it there.
pub(crate) fn info(
    module: &naga::Module,
    (variable, binding): (&GlobalVariable, ResourceBinding),
    language: Language,
    glsl: Option<&str>,
    contents: Option<String>,
) -> Option<BindingInfo> {
    let kind = BindingKind::of(binding)?;
    let is_buffer = matches!(variable.space, AddressSpace::Uniform | AddressSpace::Storage { .. });
    let at = match language {
        Language::Wgsl => BindingSlot::Wgsl { group: binding.group, binding: binding.binding },
        Language::Spirv => BindingSlot::Spirv { set: binding.group, binding: binding.binding },
        Language::Hlsl => {
            let class = match kind {
                BindingKind::Texture | BindingKind::StorageTable => 't',
                BindingKind::Sampler => 's',
                _ => 'b',
            };
            BindingSlot::Hlsl { register: format!("{class}{}", slot(binding)) }
        }
        Language::Msl => {
            let number = slot(binding) as u8;
            BindingSlot::Msl(match kind {
                BindingKind::Texture => MslSlot::Texture(number),
                BindingKind::Sampler => MslSlot::Sampler(number),
                _ => MslSlot::Buffer(number),
            })
        }
        Language::Glsl(version) => {
            let number = GlslVersion::has_bindings(version).then_some(slot(binding));
            BindingSlot::Glsl { name: glsl?.to_owned(), binding: number }
        }
    };
    let (types, inner) = (&module.types, &module.types[variable.ty].inner);
    let members = match inner {
        // To a program, a table is a single value.
        TypeInner::Struct { members, .. } if matches!(kind, BindingKind::Uniforms | BindingKind::Geometry) => members
            .iter()
            .filter_map(|m| Some(Member { name: m.name.clone()?, ty: type_text(types, m.ty)?, offset: m.offset }))
            .collect(),
        _ => Vec::new(),
    };
    Some(BindingInfo {
        kind,
        name: variable.name.clone().unwrap_or_default(),
        at,
        size: is_buffer.then(|| inner.size(module.to_ctx())),
        members,
        contents,
        channel: channel(binding),
        dimension: match inner {
            TypeInner::Image { dim: ImageDimension::D3, .. } => Some("3d"),
            TypeInner::Image { dim: ImageDimension::Cube, .. } => Some("cube"),
            TypeInner::Image { .. } => Some("2d"),
            _ => None,
        },
    })
}

/// Returns the GLSL spelling of a numeric type.
fn type_text(types: &UniqueArena<Type>, ty: naga::Handle<Type>) -> Option<String> {
    let prefix = |kind| match kind {
        ScalarKind::Sint => "i",
        ScalarKind::Uint => "u",
        _ => "",
    };
    Some(match &types[ty].inner {
        TypeInner::Scalar(scalar) => match scalar.kind {
            ScalarKind::Sint => "int".into(),
            ScalarKind::Uint => "uint".into(),
            _ => "float".into(),
        },
        TypeInner::Vector { size, scalar } => format!("{}vec{}", prefix(scalar.kind), *size as u8),
        TypeInner::Matrix { columns, rows, .. } if columns == rows => format!("mat{}", *columns as u8),
        TypeInner::Matrix { columns, rows, .. } => format!("mat{}x{}", *columns as u8, *rows as u8),
        TypeInner::Array { base, size: ArraySize::Constant(len), .. } => format!("{}[{len}]", type_text(types, *base)?),
        _ => return None,
    })
}
