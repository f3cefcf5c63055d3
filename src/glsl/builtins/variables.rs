//! Built-in variables.

use crate::types::TypeId;

/// Built-in variables (section 7.2). The `gl_Max..` constants (section 7.3) are folded to literals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BuiltinVar {
    /// `vec4`, writable, in vertex stages.
    Position,
    /// `float`, writable, in vertex stages; triangles do not use it.
    PointSize,
    /// `int`, read only, in vertex stages.
    VertexId,
    /// `int`, read only, in vertex stages; always zero.
    InstanceId,
    /// `vec4`, read only.
    FragCoord,
    /// `bool`, read only; always true except for meshes.
    FrontFacing,
    /// `vec2`, read only; always zero.
    PointCoord,
    /// `float`, writable; the depth is only read for meshes.
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

    /// Returns whether it may be written.
    pub fn is_place(self) -> bool {
        matches!(self, BuiltinVar::Position | BuiltinVar::PointSize | BuiltinVar::FragDepth)
    }

    /// Returns whether it exists in vertex stages and not in fragment stages.
    pub fn is_of_vertices(self) -> bool {
        matches!(self, BuiltinVar::Position | BuiltinVar::PointSize | BuiltinVar::VertexId | BuiltinVar::InstanceId)
    }
}
