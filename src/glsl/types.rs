//! The interned types of the language, shared by the checked program and the intermediate representation.

use super::ast::{self, BasicType};
use rustc_hash::FxHashMap;

ast::ids! {
    /// A struct type: an index into its module's structs.
    StructId;
}

/// An interned type: equal types have equal ids. The keyword types have fixed ids, for matching without a look-up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TypeId(pub u32);

impl TypeId {
    /// The type of an invalid expression. It silences every check it takes part in, and never reaches lowering.
    pub const ERROR: TypeId = TypeId(0);
    pub const VOID: TypeId = TypeId::basic(BasicType::Void);
    pub const BOOL: TypeId = TypeId::basic(BasicType::Bool);
    pub const INT: TypeId = TypeId::basic(BasicType::Int);
    pub const UINT: TypeId = TypeId::basic(BasicType::Uint);
    pub const FLOAT: TypeId = TypeId::basic(BasicType::Float);
    pub const VEC2: TypeId = TypeId::basic(BasicType::Vec2);
    pub const VEC3: TypeId = TypeId::basic(BasicType::Vec3);
    pub const VEC4: TypeId = TypeId::basic(BasicType::Vec4);

    /// Returns the id of a keyword type.
    pub const fn basic(ty: BasicType) -> Self {
        TypeId(ty as u32 + 1)
    }

    /// Returns the keyword of this type; `None` for error, arrays and structs.
    pub fn as_basic(self) -> Option<BasicType> {
        BasicType::ALL.get((self.0 as usize).checked_sub(1)?).copied()
    }

    /// Returns `bool`, `int`... for size 1, otherwise the vector of 2, 3 or 4.
    pub const fn vector(scalar: Scalar, size: u8) -> Self {
        debug_assert!(size >= 1 && size <= 4);
        let base = match scalar {
            Scalar::Bool => BasicType::Bool,
            Scalar::Int => BasicType::Int,
            Scalar::Uint => BasicType::Uint,
            Scalar::Float => BasicType::Float,
        };
        TypeId(base as u32 + size as u32)
    }

    /// Returns `matCxR`, both 2 to 4.
    pub const fn matrix(columns: u8, rows: u8) -> Self {
        debug_assert!(columns >= 2 && columns <= 4 && rows >= 2 && rows <= 4);
        TypeId(BasicType::Mat2x2 as u32 + 1 + (columns as u32 - 2) * 3 + (rows as u32 - 2))
    }
}

/// Component types. All are 32 bits wide here: precision qualifiers have no effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    Bool,
    Int,
    Uint,
    Float,
}

/// The dimensionality of a sampler's texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SamplerDim {
    /// A row of texels, only in complete fragment shaders ([`crate::Dialect::Any`]): WebGPU has it as a 2D texture.
    D1,
    D2,
    D3,
    Cube,
    D2Array,
}

impl SamplerDim {
    /// Returns the part after `sampler` in the names of such types.
    pub fn name(self) -> &'static str {
        match self {
            SamplerDim::D1 => "1D",
            SamplerDim::D2 => "2D",
            SamplerDim::D3 => "3D",
            SamplerDim::Cube => "Cube",
            SamplerDim::D2Array => "2DArray",
        }
    }
}

/// The type that a [`TypeId`] identifies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// The type of an invalid expression.
    Error,
    /// No value.
    Void,
    /// A bool or a number.
    Scalar(Scalar),
    /// `size` 2 to 4.
    Vector { scalar: Scalar, size: u8 },
    /// A matrix of floats, column-major; `matCxR` has C columns of R rows.
    Matrix { columns: u8, rows: u8 },
    /// `len` at least 1. In ESSL 3.00, which has no arrays of arrays, `element` is not an array (but may be a struct
    /// that contains one).
    Array { element: TypeId, len: u32 },
    /// A type that the program defines.
    Struct(StructId),
    /// `scalar` is the component type of a read: float, int or uint. Lowering encounters only float 2D, 3D and cube
    /// without `shadow`: there are no other channels, so no call can pass one.
    Sampler { dim: SamplerDim, scalar: Scalar, shadow: bool },
}

/// All types of a module, by [`TypeId`].
#[derive(Clone, Debug)]
pub struct TypeTable {
    types: Vec<Type>,
    arrays: FxHashMap<(TypeId, u32), TypeId>,
}

impl Default for TypeTable {
    fn default() -> Self {
        let mut types = Vec::with_capacity(64);
        types.push(Type::Error);
        types.extend(BasicType::ALL.iter().map(|&basic| basic_type(basic)));
        Self { types, arrays: FxHashMap::default() }
    }
}

/// Returns an array type as GLSL writes it: the sizes of elements that are arrays come after that of the whole.
pub(crate) fn array_text(element: &str, len: &str) -> String {
    match element.split_once('[') {
        Some((base, inner)) => format!("{base}[{len}][{inner}"),
        None => format!("{element}[{len}]"),
    }
}

impl TypeTable {
    #[inline]
    pub fn get(&self, id: TypeId) -> Type {
        self.types[id.0 as usize]
    }

    /// Returns the number of types; ids are 0 to this, and a type's element or members always come before it.
    pub fn len(&self) -> usize {
        self.types.len()
    }

    pub fn array(&mut self, element: TypeId, len: u32) -> TypeId {
        *self.arrays.entry((element, len)).or_insert_with(|| {
            self.types.push(Type::Array { element, len });
            TypeId(self.types.len() as u32 - 1)
        })
    }

    /// Adds the type of a new struct: structs are equal by declaration, not by structure. Call this once per struct.
    pub fn add_struct(&mut self, id: StructId) -> TypeId {
        self.types.push(Type::Struct(id));
        TypeId(self.types.len() as u32 - 1)
    }

    /// Returns the component type of a scalar, vector or matrix.
    pub fn scalar(&self, id: TypeId) -> Option<Scalar> {
        match self.get(id) {
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => Some(scalar),
            Type::Matrix { .. } => Some(Scalar::Float),
            _ => None,
        }
    }

    /// Returns the number of components of a scalar, vector or matrix.
    pub fn components(&self, id: TypeId) -> Option<u32> {
        match self.get(id) {
            Type::Scalar(_) => Some(1),
            Type::Vector { size, .. } => Some(size.into()),
            Type::Matrix { columns, rows } => Some(u32::from(columns) * u32::from(rows)),
            _ => None,
        }
    }

    /// Returns the type of `x[i]`: an array's element, a matrix's column, a vector's component.
    pub fn element(&self, id: TypeId) -> Option<TypeId> {
        match self.get(id) {
            Type::Array { element, .. } => Some(element),
            Type::Matrix { rows, .. } => Some(TypeId::vector(Scalar::Float, rows)),
            Type::Vector { scalar, .. } => Some(TypeId::vector(scalar, 1)),
            _ => None,
        }
    }
}

fn basic_type(basic: BasicType) -> Type {
    use BasicType as B;
    let sampler = |dim, scalar, shadow| Type::Sampler { dim, scalar, shadow };
    let vector = |scalar, size| Type::Vector { scalar, size };
    let matrix = |columns, rows| Type::Matrix { columns, rows };
    match basic {
        B::Void => Type::Void,
        B::Bool => Type::Scalar(Scalar::Bool),
        B::Int => Type::Scalar(Scalar::Int),
        B::Uint => Type::Scalar(Scalar::Uint),
        B::Float => Type::Scalar(Scalar::Float),
        B::Bvec2 => vector(Scalar::Bool, 2),
        B::Bvec3 => vector(Scalar::Bool, 3),
        B::Bvec4 => vector(Scalar::Bool, 4),
        B::Ivec2 => vector(Scalar::Int, 2),
        B::Ivec3 => vector(Scalar::Int, 3),
        B::Ivec4 => vector(Scalar::Int, 4),
        B::Uvec2 => vector(Scalar::Uint, 2),
        B::Uvec3 => vector(Scalar::Uint, 3),
        B::Uvec4 => vector(Scalar::Uint, 4),
        B::Vec2 => vector(Scalar::Float, 2),
        B::Vec3 => vector(Scalar::Float, 3),
        B::Vec4 => vector(Scalar::Float, 4),
        B::Mat2x2 => matrix(2, 2),
        B::Mat2x3 => matrix(2, 3),
        B::Mat2x4 => matrix(2, 4),
        B::Mat3x2 => matrix(3, 2),
        B::Mat3x3 => matrix(3, 3),
        B::Mat3x4 => matrix(3, 4),
        B::Mat4x2 => matrix(4, 2),
        B::Mat4x3 => matrix(4, 3),
        B::Mat4x4 => matrix(4, 4),
        B::Sampler1D => sampler(SamplerDim::D1, Scalar::Float, false),
        B::Sampler2D => sampler(SamplerDim::D2, Scalar::Float, false),
        B::Sampler3D => sampler(SamplerDim::D3, Scalar::Float, false),
        B::SamplerCube => sampler(SamplerDim::Cube, Scalar::Float, false),
        B::Sampler2DArray => sampler(SamplerDim::D2Array, Scalar::Float, false),
        B::Sampler2DShadow => sampler(SamplerDim::D2, Scalar::Float, true),
        B::SamplerCubeShadow => sampler(SamplerDim::Cube, Scalar::Float, true),
        B::Sampler2DArrayShadow => sampler(SamplerDim::D2Array, Scalar::Float, true),
        B::Isampler2D => sampler(SamplerDim::D2, Scalar::Int, false),
        B::Isampler3D => sampler(SamplerDim::D3, Scalar::Int, false),
        B::IsamplerCube => sampler(SamplerDim::Cube, Scalar::Int, false),
        B::Isampler2DArray => sampler(SamplerDim::D2Array, Scalar::Int, false),
        B::Usampler2D => sampler(SamplerDim::D2, Scalar::Uint, false),
        B::Usampler3D => sampler(SamplerDim::D3, Scalar::Uint, false),
        B::UsamplerCube => sampler(SamplerDim::Cube, Scalar::Uint, false),
        B::Usampler2DArray => sampler(SamplerDim::D2Array, Scalar::Uint, false),
    }
}

/// One to four components of a vector, 0 to 3 each, packed. The checker guarantees that they exist in the base.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Swizzle(u16);

impl Swizzle {
    /// Packs `components`, 1 to 4 entries below 4.
    pub fn new(components: &[u8]) -> Self {
        debug_assert!((1..=4).contains(&components.len()));
        let mut bits = (components.len() as u16) << 8;
        for (i, &component) in components.iter().enumerate() {
            debug_assert!(component < 4);
            bits |= u16::from(component) << (2 * i);
        }
        Self(bits)
    }

    pub fn len(self) -> usize {
        usize::from(self.0 >> 8)
    }

    pub fn get(self, i: usize) -> usize {
        usize::from(self.0 >> (2 * i)) & 3
    }

    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..self.len()).map(move |i| self.get(i))
    }

    /// Returns whether a component occurs twice, so that the swizzle is not a place.
    pub fn repeats(self) -> bool {
        let seen = self.iter().fold(0u8, |seen, c| seen | 1 << c);
        seen.count_ones() as usize != self.len()
    }
}

impl std::fmt::Debug for Swizzle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(".")?;
        self.iter().try_for_each(|c| f.write_str(["x", "y", "z", "w"][c]))
    }
}
