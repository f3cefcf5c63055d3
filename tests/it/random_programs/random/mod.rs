//! Random programs in GLSL ES 3.00 with exact arithmetic: their syntax, and the generator, printer and interpreter.
//!
//! All numbers are ints and uints, which wrap, and floats with small whole values. So a program has exactly one result
//! on every device and in [`interpret`]; any difference is a bug. Evaluation is from left to right, and variables among
//! operands are read last, as Eddy guarantees.

pub(super) mod interpret;
pub(super) mod make;
pub(super) mod print;
pub(super) mod shrink;
mod values;

/// The type of a scalar; each is one 32-bit word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    Int,
    Uint,
    Bool,
    Float,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Ty {
    /// A scalar, or a vector of 2 to 4.
    Num(Base, u8),
    /// Columns and rows.
    Mat(u8, u8),
    Array(Box<Ty>, u32),
    /// An index into [`Program::structs`].
    Struct(usize),
}

pub(super) const INT: Ty = Ty::Num(Base::Int, 1);
pub(super) const UINT: Ty = Ty::Num(Base::Uint, 1);
pub(super) const BOOL: Ty = Ty::Num(Base::Bool, 1);
pub(super) const FLOAT: Ty = Ty::Num(Base::Float, 1);

pub(super) type VarId = usize;

/// The number of times that [`Stmt::Fuel`] lets a pixel continue.
pub(super) const FUEL: i32 = 40;

#[derive(Clone, Debug)]
pub(super) struct Var {
    pub name: String,
    pub ty: Ty,
    /// Declared `const`.
    pub constant: bool,
}

/// A variable, or a part of one.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub var: VarId,
    pub path: Vec<Link>,
}

#[derive(Clone, Debug)]
pub(super) enum Link {
    Field(usize),
    Index(Box<Expr>),
    Swizzle(Vec<u8>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    And,
    Or,
    Xor,
    Shl,
    Shr,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Prefix {
    Negate,
    BitNot,
    Not,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Logic {
    And,
    Or,
    Xor,
}

#[derive(Clone, Debug)]
pub(super) enum Expr {
    /// The bits of a scalar.
    Literal(u32, Base),
    Read(Place, Ty),
    Prefix(Prefix, Box<Expr>, Ty),
    /// With the type of the result. One side may be a scalar if the other is a vector.
    Binary(Op, Box<Expr>, Box<Expr>, Ty),
    Logic(Logic, Box<Expr>, Box<Expr>),
    Ternary(Box<Expr>, Box<Expr>, Box<Expr>, Ty),
    /// A scalar converted to another type.
    Convert(Base, Box<Expr>),
    Construct(Ty, Vec<Expr>),
    Call(usize, Vec<Arg>, Ty),
    Comma(Box<Expr>, Box<Expr>),
    Assign(Place, Box<Expr>, Ty),
    AssignOp(Op, Place, Box<Expr>, Ty),
    /// `++x`, `x++`, `--x`, `x--`.
    Step {
        place: Place,
        ty: Ty,
        down: bool,
        before: bool,
    },
    /// `min` or `max`.
    Extreme {
        max: bool,
        left: Box<Expr>,
        right: Box<Expr>,
        ty: Ty,
    },
    Abs(Box<Expr>),
    /// A component of a channel's texel at int coordinates.
    Fetch {
        channel: usize,
        at: Box<(Expr, Expr)>,
        component: u8,
    },
    /// `int(p.x)`, `int(p.y)`, `iFrame`.
    Given(usize),
}

#[derive(Clone, Debug)]
pub(super) enum Arg {
    In(Expr),
    /// For an `out` or `inout` parameter.
    Place(Place),
}

#[derive(Clone, Debug)]
pub(super) enum Stmt {
    Declare(VarId, Option<Expr>),
    Expr(Expr),
    If(Expr, Vec<Stmt>, Vec<Stmt>),
    For {
        init: Option<Box<Stmt>>,
        test: Option<Expr>,
        step: Option<Expr>,
        body: Vec<Stmt>,
    },
    While(Expr, Vec<Stmt>),
    Do(Vec<Stmt>, Expr),
    /// Labels (`None`: `default`) and the statements after them.
    Switch(Expr, Vec<(Vec<Option<u32>>, Vec<Stmt>)>),
    Block(Vec<Stmt>),
    /// `if (--fuel < 0) break;`: every loop ends.
    Fuel,
    Break,
    Continue,
    Return(Option<Expr>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    In,
    Out,
    Inout,
}

#[derive(Clone, Debug)]
pub(super) struct Function {
    pub params: Vec<(VarId, Mode)>,
    /// `None`: void.
    pub result: Option<Ty>,
    pub body: Vec<Stmt>,
}

/// One pass. Its results are two words per pixel, in 16-bit halves.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    pub structs: Vec<Vec<Ty>>,
    pub vars: Vec<Var>,
    /// With their initial values, in order.
    pub globals: Vec<(VarId, Option<Expr>)>,
    pub functions: Vec<Function>,
    /// The body of `mainImage`.
    pub body: Vec<Stmt>,
    /// The variables from which the results are computed at the end, besides the globals.
    pub results: Vec<VarId>,
}

impl Program {
    /// Returns the number of 32-bit words of a value.
    pub(super) fn words(&self, ty: &Ty) -> usize {
        match ty {
            Ty::Num(_, size) => usize::from(*size),
            Ty::Mat(columns, rows) => usize::from(columns * rows),
            Ty::Array(element, len) => self.words(element) * *len as usize,
            Ty::Struct(id) => self.structs[*id].iter().map(|field| self.words(field)).sum(),
        }
    }

    /// Returns the type of a part.
    pub(super) fn part(&self, ty: &Ty, link: &Link) -> Ty {
        match (ty, link) {
            (Ty::Struct(id), Link::Field(index)) => self.structs[*id][*index].clone(),
            (Ty::Array(element, _), Link::Index(_)) => (**element).clone(),
            (Ty::Mat(_, rows), Link::Index(_)) => Ty::Num(Base::Float, *rows),
            (Ty::Num(base, _), Link::Index(_)) => Ty::Num(*base, 1),
            (Ty::Num(base, _), Link::Swizzle(components)) => Ty::Num(*base, components.len() as u8),
            other => unreachable!("{other:?}"),
        }
    }
}

impl Ty {
    /// Returns the number of elements, columns or components.
    pub(super) fn extent(&self) -> u32 {
        match self {
            Ty::Num(_, size) => (*size).into(),
            Ty::Mat(columns, _) => (*columns).into(),
            Ty::Array(_, len) => *len,
            Ty::Struct(_) => unreachable!("a structure is not indexed"),
        }
    }

    pub(super) fn base(&self) -> Option<Base> {
        match self {
            Ty::Num(base, _) => Some(*base),
            _ => None,
        }
    }
}

impl Expr {
    pub(super) fn ty(&self) -> Ty {
        match self {
            Expr::Literal(_, base) | Expr::Convert(base, _) => Ty::Num(*base, 1),
            Expr::Logic(..) => BOOL,
            Expr::Abs(_) | Expr::Given(_) => INT,
            Expr::Fetch { .. } => FLOAT,
            Expr::Comma(_, last) => last.ty(),
            Expr::Read(_, ty)
            | Expr::Prefix(_, _, ty)
            | Expr::Binary(_, _, _, ty)
            | Expr::Ternary(_, _, _, ty)
            | Expr::Construct(ty, _)
            | Expr::Call(_, _, ty)
            | Expr::Assign(_, _, ty)
            | Expr::AssignOp(_, _, _, ty)
            | Expr::Step { ty, .. }
            | Expr::Extreme { ty, .. } => ty.clone(),
        }
    }

    /// Returns the operands of this expression, including those in indices.
    fn parts(&self) -> Vec<&Expr> {
        let mut out: Vec<&Expr> = Vec::new();
        match self {
            Expr::Literal(..) | Expr::Given(_) => {}
            Expr::Read(place, _) | Expr::Step { place, .. } => out.extend(place.indices()),
            Expr::Prefix(_, a, _) | Expr::Convert(_, a) | Expr::Abs(a) => out.push(a),
            Expr::Binary(_, a, b, _)
            | Expr::Logic(_, a, b)
            | Expr::Comma(a, b)
            | Expr::Extreme { left: a, right: b, .. } => out.extend([&**a, &**b]),
            Expr::Ternary(a, b, c, _) => out.extend([&**a, &**b, &**c]),
            Expr::Construct(_, parts) => out.extend(parts),
            Expr::Call(_, args, _) => {
                for arg in args {
                    match arg {
                        Arg::In(value) => out.push(value),
                        Arg::Place(place) => out.extend(place.indices()),
                    }
                }
            }
            Expr::Assign(place, value, _) | Expr::AssignOp(_, place, value, _) => {
                out.extend(place.indices());
                out.push(value);
            }
            Expr::Fetch { at, .. } => out.extend([&at.0, &at.1]),
        }
        out
    }

    /// Returns whether it has side effects, or calls a function, which may.
    pub(super) fn has_effects(&self) -> bool {
        matches!(self, Expr::Assign(..) | Expr::AssignOp(..) | Expr::Step { .. } | Expr::Call(..))
            || self.parts().into_iter().any(Expr::has_effects)
    }

    /// Returns whether it is a constant expression.
    pub(super) fn is_constant(&self, vars: &[Var]) -> bool {
        let own = match self {
            Expr::Read(place, _) => vars[place.var].constant,
            Expr::Fetch { .. } | Expr::Given(_) => false,
            _ => !self.has_effects(),
        };
        own && self.parts().into_iter().all(|part| part.is_constant(vars))
    }
}

impl Place {
    pub(super) fn whole(var: VarId) -> Self {
        Place { var, path: Vec::new() }
    }

    pub(super) fn indices(&self) -> impl Iterator<Item = &Expr> {
        self.path.iter().filter_map(|link| match link {
            Link::Index(index) => Some(&**index),
            _ => None,
        })
    }
}
