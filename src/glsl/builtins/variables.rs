//! Built-in variables.

use crate::types::TypeId;

/// Built-in variables (section 7.2). The `gl_Max..` constants (section 7.3) are folded to literals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BuiltinVar {
    /// `vec4`, a place of vertex stages.
    Position,
    /// `float`, a place of vertex stages; triangles have no use for it.
    PointSize,
    /// `int`, read only, in vertex stages.
    VertexId,
    /// `int`, read only, in vertex stages; always zero.
    InstanceId,
    /// `vec4`, read only.
    FragCoord,
    /// `bool`, read only; always true but for meshes.
    FrontFacing,
    /// `vec2`, read only; always zero.
    PointCoord,
    /// `float`, a place; nobody reads the depth but for meshes.
    FragDepth,
}

impl BuiltinVar {
    pub fn ty(self) -> TypeId {
        match self {
            BuiltinVar::Position | BuiltinVar::FragCoord => TypeId::VEC4,
            BuiltinVar::PointSize | BuiltinVar::FragDepth => TypeId::FLOAT,
            BuiltinVar::VertexId | BuiltinVar::InstanceId => TypeId::INT,
            BuiltinVar::FrontFacing => TypeId::BOOL,
            BuiltinVar::PointCoord => TypeId::VEC2,
        }
    }

    /// It may be written.
    pub fn is_place(self) -> bool {
        matches!(self, BuiltinVar::Position | BuiltinVar::PointSize | BuiltinVar::FragDepth)
    }

    /// It belongs to vertex stages, and not to what draws fragments.
    pub fn is_of_vertices(self) -> bool {
        matches!(self, BuiltinVar::Position | BuiltinVar::PointSize | BuiltinVar::VertexId | BuiltinVar::InstanceId)
    }
}
