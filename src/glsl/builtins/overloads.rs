//! Overloads as patterns over sizes, and the search for the one that accepts given types.

use crate::{
    ast::BasicType,
    types::{SamplerDim, Scalar, Type, TypeId, TypeTable},
};

/// The type of a parameter or result in an overload. Sizes and matrices agree within one overload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// `genType`, `genIType`, `genUType`, `genBType`: a scalar or vector.
    Gen(Scalar),
    /// `vec`, `ivec`, `uvec`, `bvec`: a vector.
    Vector(Scalar),
    /// `mat`: any matrix.
    Matrix,
    /// Any square matrix.
    Square,
    /// As a result: the transpose of the matrix.
    Transposed,
    /// A sampler of floats, ints or uints; those that compare return floats.
    Sampler(SamplerDim, bool),
    /// As a result: `gvec4`, of the sampler's component type.
    Texel,
    Exactly(TypeId),
}

#[derive(Debug)]
pub struct Overload {
    pub result: Pattern,
    pub params: &'static [Pattern],
}

/// Returns an overload with this result and these parameters.
pub(super) const fn sig(result: Pattern, params: &'static [Pattern]) -> Overload {
    Overload { result, params }
}

/// Short names of the patterns, for the rows.
pub(super) mod patterns {
    use super::{Overload, Pattern, sig};
    use crate::types::{SamplerDim, Scalar, TypeId};

    pub(crate) const MAT: Pattern = Pattern::Matrix;
    pub(crate) const SQUARE: Pattern = Pattern::Square;
    pub(crate) const TRANSPOSED: Pattern = Pattern::Transposed;
    pub(crate) const G4: Pattern = Pattern::Texel;
    pub(crate) const F: Pattern = Pattern::Gen(Scalar::Float);
    pub(crate) const I: Pattern = Pattern::Gen(Scalar::Int);
    pub(crate) const U: Pattern = Pattern::Gen(Scalar::Uint);
    pub(crate) const B: Pattern = Pattern::Gen(Scalar::Bool);
    pub(crate) const VF: Pattern = Pattern::Vector(Scalar::Float);
    pub(crate) const VI: Pattern = Pattern::Vector(Scalar::Int);
    pub(crate) const VU: Pattern = Pattern::Vector(Scalar::Uint);
    pub(crate) const VB: Pattern = Pattern::Vector(Scalar::Bool);
    pub(crate) const VOID: Pattern = Pattern::Exactly(TypeId::VOID);
    pub(crate) const BOOL: Pattern = Pattern::Exactly(TypeId::BOOL);
    pub(crate) const F1: Pattern = Pattern::Exactly(TypeId::FLOAT);
    pub(crate) const F2: Pattern = Pattern::Exactly(TypeId::VEC2);
    pub(crate) const F3: Pattern = Pattern::Exactly(TypeId::VEC3);
    pub(crate) const F4: Pattern = Pattern::Exactly(TypeId::VEC4);
    pub(crate) const I1: Pattern = Pattern::Exactly(TypeId::INT);
    pub(crate) const I2: Pattern = Pattern::Exactly(TypeId::vector(Scalar::Int, 2));
    pub(crate) const I3: Pattern = Pattern::Exactly(TypeId::vector(Scalar::Int, 3));
    pub(crate) const U1: Pattern = Pattern::Exactly(TypeId::UINT);
    pub(crate) const S1: Pattern = Pattern::Sampler(SamplerDim::D1, false);
    pub(crate) const S2: Pattern = Pattern::Sampler(SamplerDim::D2, false);
    pub(crate) const S3: Pattern = Pattern::Sampler(SamplerDim::D3, false);
    pub(crate) const SC: Pattern = Pattern::Sampler(SamplerDim::Cube, false);
    pub(crate) const SA: Pattern = Pattern::Sampler(SamplerDim::D2Array, false);
    pub(crate) const D2: Pattern = Pattern::Sampler(SamplerDim::D2, true);
    pub(crate) const DC: Pattern = Pattern::Sampler(SamplerDim::Cube, true);
    pub(crate) const DA: Pattern = Pattern::Sampler(SamplerDim::D2Array, true);

    pub(crate) const fn mat(columns: u8, rows: u8) -> Pattern {
        Pattern::Exactly(TypeId::matrix(columns, rows))
    }

    /// `genType f(genType)`.
    pub(crate) const FLOAT: &[Overload] = &[sig(F, &[F])];
    /// `genType f(genType, genType)`.
    pub(crate) const FLOATS: &[Overload] = &[sig(F, &[F, F])];
}

/// The bindings of one overload's patterns, from the arguments so far.
#[derive(Clone, Copy)]
struct Bound {
    size: u8,
    matrix: TypeId,
    texel: Scalar,
}

impl Overload {
    /// Returns the result's type if the overload accepts these arguments.
    pub fn result_for(&self, args: &[TypeId], types: &TypeTable) -> Option<TypeId> {
        if args.len() != self.params.len() {
            return None;
        }
        let mut bound = Bound { size: 0, matrix: TypeId::ERROR, texel: Scalar::Float };
        let fits = self.params.iter().zip(args).all(|(&pattern, &arg)| bind(pattern, arg, &mut bound, types));
        fits.then(|| instance(self.result, bound, types))
    }

    /// Returns whether it reads a row of texels, which GLSL ES and Shadertoy do not have.
    pub fn is_one_dimensional(&self) -> bool {
        self.params.first() == Some(&Pattern::Sampler(SamplerDim::D1, false))
    }

    /// Returns whether these can be the first arguments.
    pub fn accepts_first(&self, args: &[TypeId], types: &TypeTable) -> bool {
        let mut bound = Bound { size: 0, matrix: TypeId::ERROR, texel: Scalar::Float };
        args.len() <= self.params.len()
            && self.params.iter().zip(args).all(|(&pattern, &arg)| bind(pattern, arg, &mut bound, types))
    }

    /// Returns the parameters' types where generic ones have `size` components; samplers and matrices are those of the
    /// arguments.
    pub fn params_at(&self, size: u8, given: &[TypeId], types: &TypeTable) -> Option<Vec<TypeId>> {
        if given.len() != self.params.len() {
            return None;
        }
        let at = |(&pattern, &given): (&Pattern, &TypeId)| match pattern {
            Pattern::Exactly(ty) => Some(ty),
            Pattern::Gen(scalar) => Some(TypeId::vector(scalar, size)),
            Pattern::Vector(scalar) if size > 1 => Some(TypeId::vector(scalar, size)),
            Pattern::Vector(_) | Pattern::Transposed | Pattern::Texel => None,
            Pattern::Matrix | Pattern::Square => matches!(types.get(given), Type::Matrix { .. }).then_some(given),
            Pattern::Sampler(dim, shadow) => match types.get(given) {
                Type::Sampler { dim: d, shadow: s, .. } => (d == dim && s == shadow).then_some(given),
                _ => None,
            },
        };
        self.params.iter().zip(given).map(at).collect()
    }

    /// Returns the types to show for a pattern where the arguments have `size` components.
    pub fn shown(&self, pattern: Pattern, size: u8) -> String {
        let size = size.max(1);
        let prefix = |scalar| match scalar {
            Scalar::Float => "",
            Scalar::Int => "i",
            Scalar::Uint => "u",
            Scalar::Bool => "b",
        };
        match pattern {
            Pattern::Gen(scalar) => name(TypeId::vector(scalar, size)),
            Pattern::Vector(scalar) if size > 1 => name(TypeId::vector(scalar, size)),
            Pattern::Vector(scalar) => format!("{}vecN", prefix(scalar)),
            Pattern::Matrix => "matCxR".to_owned(),
            Pattern::Square => "matN".to_owned(),
            Pattern::Transposed => "matRxC".to_owned(),
            Pattern::Texel => "vec4".to_owned(),
            Pattern::Sampler(dim, shadow) => {
                let dim = dim.name();
                format!("sampler{dim}{}", if shadow { "Shadow" } else { "" })
            }
            Pattern::Exactly(ty) => name(ty),
        }
    }
}

fn name(ty: TypeId) -> String {
    ty.as_basic().map_or("?", BasicType::name).to_owned()
}

#[inline]
fn bind(pattern: Pattern, arg: TypeId, bound: &mut Bound, types: &TypeTable) -> bool {
    match pattern {
        Pattern::Exactly(ty) => ty == arg,
        Pattern::Gen(wanted) | Pattern::Vector(wanted) => {
            let (scalar, size) = match types.get(arg) {
                Type::Scalar(scalar) if pattern == Pattern::Gen(wanted) => (scalar, 1),
                Type::Vector { scalar, size } => (scalar, size),
                _ => return false,
            };
            let fits = scalar == wanted && (bound.size == 0 || bound.size == size);
            bound.size = size;
            fits
        }
        Pattern::Matrix | Pattern::Square => {
            let Type::Matrix { columns, rows } = types.get(arg) else { return false };
            let fits = (pattern == Pattern::Matrix || columns == rows)
                && (bound.matrix == TypeId::ERROR || bound.matrix == arg);
            bound.matrix = arg;
            fits
        }
        Pattern::Sampler(wanted, compares) => {
            let Type::Sampler { dim, scalar, shadow } = types.get(arg) else { return false };
            bound.texel = scalar;
            dim == wanted && shadow == compares
        }
        Pattern::Transposed | Pattern::Texel => false,
    }
}

fn instance(pattern: Pattern, bound: Bound, types: &TypeTable) -> TypeId {
    match pattern {
        Pattern::Exactly(ty) => ty,
        Pattern::Gen(scalar) | Pattern::Vector(scalar) => TypeId::vector(scalar, bound.size),
        Pattern::Texel => TypeId::vector(bound.texel, 4),
        Pattern::Matrix | Pattern::Square => bound.matrix,
        Pattern::Transposed => match types.get(bound.matrix) {
            Type::Matrix { columns, rows } => TypeId::matrix(rows, columns),
            _ => TypeId::ERROR,
        },
        Pattern::Sampler(..) => unreachable!("no built-in returns a sampler"),
    }
}
