//! The built-in functions of chapter 8: every overload, as patterns over sizes, and finding the one that takes given
//! types.

use crate::{
    ast::BasicType,
    hir::{Builtin, SamplerDim, Scalar, Type, TypeId, TypeTable},
};

/// A parameter's or result's type in an overload. Sizes and matrices agree within one overload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pattern {
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
    /// A sampler of floats, ints or uints; those that compare give floats.
    Sampler(SamplerDim, bool),
    /// As a result: `gvec4`, of the sampler's components.
    Texel,
    Exactly(TypeId),
}

#[derive(Debug)]
pub(crate) struct Overload {
    pub result: Pattern,
    pub params: &'static [Pattern],
}

use Pattern::{Matrix as M, Square as Q, Texel as G, Transposed as MT};
const F: Pattern = Pattern::Gen(Scalar::Float);
const I: Pattern = Pattern::Gen(Scalar::Int);
const U: Pattern = Pattern::Gen(Scalar::Uint);
const B: Pattern = Pattern::Gen(Scalar::Bool);
const VF: Pattern = Pattern::Vector(Scalar::Float);
const VI: Pattern = Pattern::Vector(Scalar::Int);
const VU: Pattern = Pattern::Vector(Scalar::Uint);
const VB: Pattern = Pattern::Vector(Scalar::Bool);
const VOID: Pattern = Pattern::Exactly(TypeId::VOID);
const BOOL: Pattern = Pattern::Exactly(TypeId::BOOL);
const F1: Pattern = Pattern::Exactly(TypeId::FLOAT);
const F2: Pattern = Pattern::Exactly(TypeId::VEC2);
const F3: Pattern = Pattern::Exactly(TypeId::VEC3);
const F4: Pattern = Pattern::Exactly(TypeId::VEC4);
const I1: Pattern = Pattern::Exactly(TypeId::INT);
const I2: Pattern = Pattern::Exactly(TypeId::vector(Scalar::Int, 2));
const I3: Pattern = Pattern::Exactly(TypeId::vector(Scalar::Int, 3));
const U1: Pattern = Pattern::Exactly(TypeId::UINT);
const S2: Pattern = Pattern::Sampler(SamplerDim::D2, false);
const S3: Pattern = Pattern::Sampler(SamplerDim::D3, false);
const SC: Pattern = Pattern::Sampler(SamplerDim::Cube, false);
const SA: Pattern = Pattern::Sampler(SamplerDim::D2Array, false);
const D2: Pattern = Pattern::Sampler(SamplerDim::D2, true);
const DC: Pattern = Pattern::Sampler(SamplerDim::Cube, true);
const DA: Pattern = Pattern::Sampler(SamplerDim::D2Array, true);

const fn mat(columns: u8, rows: u8) -> Pattern {
    Pattern::Exactly(TypeId::matrix(columns, rows))
}

/// `result: parameters;` for each overload.
macro_rules! overloads {
    ($($result:expr => $($param:expr),+;)+) => {
        const { &[$(Overload { result: $result, params: &[$($param),+] }),+] }
    };
}

/// Every overload of a built-in, the commoner ones first.
#[rustfmt::skip]
pub(crate) fn of(builtin: Builtin) -> &'static [Overload] {
    use Builtin as X;
    match builtin {
        X::Radians | X::Degrees | X::Sin | X::Cos | X::Tan | X::Asin | X::Acos | X::Sinh | X::Cosh | X::Tanh | X::Asinh
        | X::Acosh | X::Atanh | X::Exp | X::Log | X::Exp2 | X::Log2 | X::Sqrt | X::InverseSqrt | X::Floor | X::Trunc
        | X::Round | X::RoundEven | X::Ceil | X::Fract | X::Normalize | X::DFdx | X::DFdy | X::Fwidth => {
            overloads! { F => F; }
        }
        X::Atan => overloads! { F => F, F; F => F; },
        X::Pow | X::Reflect | X::Modf => overloads! { F => F, F; },
        X::Abs | X::Sign => overloads! { F => F; I => I; },
        X::Mod => overloads! { F => F, F; F => F, F1; },
        X::Min | X::Max => overloads! {
            F => F, F; F => F, F1; I => I, I; I => I, I1; U => U, U; U => U, U1;
        },
        X::Clamp => overloads! {
            F => F, F, F; F => F, F1, F1; I => I, I, I; I => I, I1, I1; U => U, U, U; U => U, U1, U1;
        },
        X::Mix => overloads! { F => F, F, F; F => F, F, F1; F => F, F, B; },
        X::Step => overloads! { F => F, F; F => F1, F; },
        X::Smoothstep => overloads! { F => F, F, F; F => F1, F1, F; },
        X::IsNan | X::IsInf => overloads! { B => F; },
        X::FloatBitsToInt => overloads! { I => F; },
        X::FloatBitsToUint => overloads! { U => F; },
        X::IntBitsToFloat => overloads! { F => I; },
        X::UintBitsToFloat => overloads! { F => U; },
        X::PackSnorm2x16 | X::PackUnorm2x16 | X::PackHalf2x16 => overloads! { U1 => F2; },
        X::UnpackSnorm2x16 | X::UnpackUnorm2x16 | X::UnpackHalf2x16 => overloads! { F2 => U1; },
        X::Length => overloads! { F1 => F; },
        X::Distance | X::Dot => overloads! { F1 => F, F; },
        X::Cross => overloads! { F3 => F3, F3; },
        X::FaceForward => overloads! { F => F, F, F; },
        X::Refract => overloads! { F => F, F, F1; },
        X::MatrixCompMult => overloads! { M => M, M; },
        X::OuterProduct => overloads! {
            mat(2, 2) => F2, F2; mat(3, 3) => F3, F3; mat(4, 4) => F4, F4;
            mat(2, 3) => F3, F2; mat(3, 2) => F2, F3; mat(2, 4) => F4, F2;
            mat(4, 2) => F2, F4; mat(3, 4) => F4, F3; mat(4, 3) => F3, F4;
        },
        X::Transpose => overloads! { MT => M; },
        X::Determinant => overloads! { F1 => Q; },
        X::Inverse => overloads! { Q => Q; },
        X::LessThan | X::LessThanEqual | X::GreaterThan | X::GreaterThanEqual => overloads! {
            VB => VF, VF; VB => VI, VI; VB => VU, VU;
        },
        X::Equal | X::NotEqual => overloads! { VB => VF, VF; VB => VI, VI; VB => VU, VU; VB => VB, VB; },
        X::Any | X::All => overloads! { BOOL => VB; },
        X::Not => overloads! { VB => VB; },
        X::TextureSize => overloads! {
            I2 => S2, I1; I3 => S3, I1; I2 => SC, I1; I3 => SA, I1; I2 => D2, I1; I2 => DC, I1; I3 => DA, I1;
        },
        X::Texture => overloads! {
            G => S2, F2; G => S2, F2, F1; G => S3, F3; G => S3, F3, F1; G => SC, F3; G => SC, F3, F1;
            G => SA, F3; G => SA, F3, F1; F1 => D2, F3; F1 => D2, F3, F1; F1 => DC, F4; F1 => DC, F4, F1; F1 => DA, F4;
        },
        X::TextureProj => overloads! {
            G => S2, F3; G => S2, F3, F1; G => S2, F4; G => S2, F4, F1; G => S3, F4; G => S3, F4, F1;
            F1 => D2, F4; F1 => D2, F4, F1;
        },
        X::TextureLod => overloads! {
            G => S2, F2, F1; G => S3, F3, F1; G => SC, F3, F1; G => SA, F3, F1; F1 => D2, F3, F1;
        },
        X::TextureOffset => overloads! {
            G => S2, F2, I2; G => S2, F2, I2, F1; G => S3, F3, I3; G => S3, F3, I3, F1;
            G => SA, F3, I2; G => SA, F3, I2, F1; F1 => D2, F3, I2; F1 => D2, F3, I2, F1;
        },
        X::TexelFetch => overloads! { G => S2, I2, I1; G => S3, I3, I1; G => SA, I3, I1; },
        X::TexelFetchOffset => overloads! { G => S2, I2, I1, I2; G => S3, I3, I1, I3; G => SA, I3, I1, I2; },
        X::TextureProjOffset => overloads! {
            G => S2, F3, I2; G => S2, F3, I2, F1; G => S2, F4, I2; G => S2, F4, I2, F1;
            G => S3, F4, I3; G => S3, F4, I3, F1; F1 => D2, F4, I2; F1 => D2, F4, I2, F1;
        },
        X::TextureLodOffset => overloads! {
            G => S2, F2, F1, I2; G => S3, F3, F1, I3; G => SA, F3, F1, I2; F1 => D2, F3, F1, I2;
        },
        X::TextureProjLod => overloads! { G => S2, F3, F1; G => S2, F4, F1; G => S3, F4, F1; F1 => D2, F4, F1; },
        X::TextureProjLodOffset => overloads! {
            G => S2, F3, F1, I2; G => S2, F4, F1, I2; G => S3, F4, F1, I3; F1 => D2, F4, F1, I2;
        },
        X::TextureGrad => overloads! {
            G => S2, F2, F2, F2; G => S3, F3, F3, F3; G => SC, F3, F3, F3; G => SA, F3, F2, F2;
            F1 => D2, F3, F2, F2; F1 => DC, F4, F3, F3; F1 => DA, F4, F2, F2;
        },
        X::TextureGradOffset => overloads! {
            G => S2, F2, F2, F2, I2; G => S3, F3, F3, F3, I3; G => SA, F3, F2, F2, I2;
            F1 => D2, F3, F2, F2, I2; F1 => DA, F4, F2, F2, I2;
        },
        X::TextureProjGrad => overloads! {
            G => S2, F3, F2, F2; G => S2, F4, F2, F2; G => S3, F4, F3, F3; F1 => D2, F4, F2, F2;
        },
        X::TextureProjGradOffset => overloads! {
            G => S2, F3, F2, F2, I2; G => S2, F4, F2, F2, I2; G => S3, F4, F3, F3, I3; F1 => D2, F4, F2, F2, I2;
        },
        X::StAssert => overloads! { VOID => BOOL; VOID => BOOL, I1; },
    }
}

/// Section 6.1 forbids to declare a built-in again, but ANGLE, and so the site, takes overloads of these.
pub(super) fn may_be_overloaded(builtin: Builtin) -> bool {
    use Builtin as X;
    matches!(builtin, X::Mix | X::TextureSize | X::Texture | X::TextureLod | X::TexelFetch | X::TextureGrad)
}

/// Returns the argument that is the constant offset (section 8.8).
pub(super) fn offset_argument(builtin: Builtin) -> Option<usize> {
    use Builtin as X;
    match builtin {
        X::TextureOffset | X::TextureProjOffset => Some(2),
        X::TexelFetchOffset | X::TextureLodOffset | X::TextureProjLodOffset => Some(3),
        X::TextureGradOffset | X::TextureProjGradOffset => Some(4),
        _ => None,
    }
}

/// Holds what the patterns of one overload have been bound to by the arguments so far.
#[derive(Clone, Copy)]
struct Bound {
    size: u8,
    matrix: TypeId,
    texel: Scalar,
}

impl Overload {
    /// The result's type if the overload takes these arguments.
    pub fn result_for(&self, args: &[TypeId], types: &TypeTable) -> Option<TypeId> {
        if args.len() != self.params.len() {
            return None;
        }
        let mut bound = Bound { size: 0, matrix: TypeId::ERROR, texel: Scalar::Float };
        let fits = self.params.iter().zip(args).all(|(&pattern, &arg)| bind(pattern, arg, &mut bound, types));
        fits.then(|| instance(self.result, bound, types))
    }

    /// Returns whether these can be the first arguments.
    pub fn begins_with(&self, args: &[TypeId], types: &TypeTable) -> bool {
        let mut bound = Bound { size: 0, matrix: TypeId::ERROR, texel: Scalar::Float };
        args.len() <= self.params.len()
            && self.params.iter().zip(args).all(|(&pattern, &arg)| bind(pattern, arg, &mut bound, types))
    }

    /// The parameters' types where generic ones have `size` components; samplers and matrices as the arguments have
    /// them.
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

    /// Types to show for a pattern where the arguments have `size` components.
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
