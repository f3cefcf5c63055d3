//! Says what the language and the site bring along: built-in functions, uniforms, variables.

use super::{
    ast::Symbol,
    types::{TypeId, TypeTable},
};

/// Declares an enum of names that are seeded into the interner in order.
macro_rules! named {
    ($(#[$doc:meta])* $enum:ident, $seed:expr; $($(#[$vdoc:meta])* $name:ident = $text:literal;)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u8)]
        pub enum $enum { $($(#[$vdoc])* $name,)* }

        impl $enum {
            /// All, in order of their symbols.
            pub const ALL: &'static [$enum] = &[$($enum::$name),*];

            /// As GLSL spells it.
            pub fn name(self) -> &'static str {
                match self { $($enum::$name => $text,)* }
            }

            /// Returns what a symbol names, by the order of the interner's seed ([`super::ast::Interner`] says how it
            /// must begin).
            #[inline]
            pub fn from_symbol(symbol: Symbol) -> Option<Self> {
                Self::ALL.get((symbol.0 as usize).checked_sub($seed)?).copied()
            }

            /// The opposite of `from_symbol`.
            #[inline]
            pub fn symbol(self) -> Symbol {
                Symbol(self as u32 + $seed as u32)
            }
        }
    };
}

named! {
    /// A function of chapter 8, one variant a name; overloads are told apart by the arguments' types. Ours is
    /// `st_assert`. ESSL 3.00 lets nobody redefine or overload them (section 6.1), but a variable or struct of the name
    /// hides them.
    Builtin, 0usize;
    // 8.1 Angle and trigonometry.
    Radians = "radians";
    Degrees = "degrees";
    Sin = "sin";
    Cos = "cos";
    Tan = "tan";
    Asin = "asin";
    Acos = "acos";
    /// One argument, or two: `atan(y, x)`.
    Atan = "atan";
    Sinh = "sinh";
    Cosh = "cosh";
    Tanh = "tanh";
    Asinh = "asinh";
    Acosh = "acosh";
    Atanh = "atanh";
    // 8.2 Exponential.
    Pow = "pow";
    Exp = "exp";
    Log = "log";
    Exp2 = "exp2";
    Log2 = "log2";
    Sqrt = "sqrt";
    InverseSqrt = "inversesqrt";
    // 8.3 Common. Second and third arguments may be scalars where the first is a vector, as the overloads say.
    Abs = "abs";
    Sign = "sign";
    Floor = "floor";
    Trunc = "trunc";
    Round = "round";
    RoundEven = "roundEven";
    Ceil = "ceil";
    Fract = "fract";
    Mod = "mod";
    /// The second argument is an `out` place.
    Modf = "modf";
    Min = "min";
    Max = "max";
    Clamp = "clamp";
    /// Third argument: the type of the first, a float, or bools (then it selects).
    Mix = "mix";
    /// The first argument may be a scalar.
    Step = "step";
    /// The first two arguments may be scalars.
    Smoothstep = "smoothstep";
    IsNan = "isnan";
    IsInf = "isinf";
    FloatBitsToInt = "floatBitsToInt";
    FloatBitsToUint = "floatBitsToUint";
    IntBitsToFloat = "intBitsToFloat";
    UintBitsToFloat = "uintBitsToFloat";
    // 8.4 Packing.
    PackSnorm2x16 = "packSnorm2x16";
    UnpackSnorm2x16 = "unpackSnorm2x16";
    PackUnorm2x16 = "packUnorm2x16";
    UnpackUnorm2x16 = "unpackUnorm2x16";
    PackHalf2x16 = "packHalf2x16";
    UnpackHalf2x16 = "unpackHalf2x16";
    // 8.5 Geometry; all but `cross` take floats as vectors of one.
    Length = "length";
    Distance = "distance";
    Dot = "dot";
    Cross = "cross";
    Normalize = "normalize";
    FaceForward = "faceforward";
    Reflect = "reflect";
    Refract = "refract";
    // 8.6 Matrices.
    MatrixCompMult = "matrixCompMult";
    OuterProduct = "outerProduct";
    Transpose = "transpose";
    Determinant = "determinant";
    Inverse = "inverse";
    // 8.7 Vector relations, component by component.
    LessThan = "lessThan";
    LessThanEqual = "lessThanEqual";
    GreaterThan = "greaterThan";
    GreaterThanEqual = "greaterThanEqual";
    Equal = "equal";
    NotEqual = "notEqual";
    Any = "any";
    All = "all";
    Not = "not";
    // 8.8 Textures; the sampler comes first.
    TextureSize = "textureSize";
    /// With or without bias.
    Texture = "texture";
    /// With or without bias; the coordinate's last component divides.
    TextureProj = "textureProj";
    TextureLod = "textureLod";
    TextureOffset = "textureOffset";
    TexelFetch = "texelFetch";
    TexelFetchOffset = "texelFetchOffset";
    TextureProjOffset = "textureProjOffset";
    TextureLodOffset = "textureLodOffset";
    TextureProjLod = "textureProjLod";
    TextureProjLodOffset = "textureProjLodOffset";
    TextureGrad = "textureGrad";
    TextureGradOffset = "textureGradOffset";
    TextureProjGrad = "textureProjGrad";
    TextureProjGradOffset = "textureProjGradOffset";
    // 8.9 Derivatives.
    DFdx = "dFdx";
    DFdy = "dFdy";
    Fwidth = "fwidth";
    // The site's own, in Image passes: `st_assert(bool)` and `st_assert(bool, int)`, void.
    StAssert = "st_assert";
}

named! {
    /// The site's uniforms, in the order of `interface::UniformBlock`. Which of them a pass may name is the checker's
    /// matter.
    Uniform, Builtin::ALL.len();
    Resolution = "iResolution";
    Time = "iTime";
    Mouse = "iMouse";
    Date = "iDate";
    TimeDelta = "iTimeDelta";
    FrameRate = "iFrameRate";
    SampleRate = "iSampleRate";
    Frame = "iFrame";
    /// `float[4]`; also `iCh0.time` as an `Index` of it.
    ChannelTime = "iChannelTime";
    /// `vec3[4]`; also `iCh0.size`.
    ChannelResolution = "iChannelResolution";
    TimeOffset = "iTimeOffset";
    SampleOffset = "iSampleOffset";
    // Of programs that draw meshes, in the order of `interface::GeometryBlock`.
    Model = "iModel";
    View = "iView";
    Projection = "iProjection";
    NormalMatrix = "iNormalMatrix";
    CameraPosition = "iCameraPosition";
    /// `int[4]`, reached only as `iCh0.loaded`; its name is no identifier a user can write.
    ChannelLoaded = "iCh*.loaded";
}

impl Builtin {
    /// Returns whether it is of section 8.8, texture look-up functions.
    pub fn is_texture(self) -> bool {
        (Builtin::TextureSize..=Builtin::TextureProjGradOffset).contains(&self)
    }
}

impl Uniform {
    /// Its place in `interface::GeometryBlock`, if it is of that.
    pub fn geometry_member(self) -> Option<u32> {
        match self {
            Uniform::Model => Some(0),
            Uniform::View => Some(1),
            Uniform::Projection => Some(2),
            Uniform::NormalMatrix => Some(3),
            Uniform::CameraPosition => Some(4),
            _ => None,
        }
    }

    /// Its type; the arrays are interned on the way.
    pub fn ty(self, types: &mut TypeTable) -> TypeId {
        match self {
            Uniform::Resolution | Uniform::CameraPosition => TypeId::VEC3,
            Uniform::Model | Uniform::View | Uniform::Projection => TypeId::matrix(4, 4),
            Uniform::NormalMatrix => TypeId::matrix(3, 3),
            Uniform::Mouse | Uniform::Date => TypeId::VEC4,
            Uniform::Time | Uniform::TimeDelta | Uniform::FrameRate | Uniform::SampleRate | Uniform::TimeOffset => {
                TypeId::FLOAT
            }
            Uniform::Frame | Uniform::SampleOffset => TypeId::INT,
            Uniform::ChannelTime => types.array(TypeId::FLOAT, 4),
            Uniform::ChannelResolution => types.array(TypeId::VEC3, 4),
            Uniform::ChannelLoaded => types.array(TypeId::INT, 4),
        }
    }
}

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
