//! The checked program: typed, resolved, constants folded. The checker creates it from [`super::ast`], lowering
//! translates it to [`super::ir`], editor services read its side tables.
//!
//! The checker creates a [`Module`] for any tree, so that editors work on text that does not compile. Lowering runs
//! only if no error was reported; it may then rely on everything documented here, and on the absence of `Error`
//! expressions and [`TypeId::ERROR`] in everything reachable from [`Module::entry`].
//!
//! Guarantees of the checker, beyond those on the items:
//! - Ids are in post-order (child < parent) and every node has at most one parent: a tree, no sharing. Folding leaves
//!   nodes without a parent, which are harmless.
//! - Depth is bounded by a small multiple of [`super::ast::MAX_NESTING`], apart from the left spines (`Binary.lhs`,
//!   `Logical.lhs`, `Comma.lhs`, and `base` of `Member`, `Swizzle` and `Index`) with at most one inserted node
//!   (`Convert`) per link: walk these with a loop.
//! - No implicit conversion is left: operand types match exactly as each kind documents. Where we share ANGLE's
//!   leniency, there is an explicit [`ExprKind::Convert`].
//! - Operands are evaluated left to right, each once, and operands that are variables are read after the effects of
//!   all, as in ANGLE ([`super::unsequenced`]). Lowering keeps that order observable wherever [`ExprFlags::EFFECTS`] is
//!   set in a sibling.
//! - Zero is implied: a variable without initialiser is zero each time its declaration is executed, an `out` parameter
//!   is zero at entry, a non-void function that ends without `return` returns zero. No expression represents it;
//!   lowering generates it.

mod declarations;
mod ids;

use super::{
    ast::{self, Ident, List, Loc, Symbol, TokenId},
    types,
};
pub(crate) use super::{
    builtins::{Builtin, BuiltinVar, Uniform},
    types::{SamplerDim, Scalar, StructId, Swizzle, Type, TypeId, TypeTable},
};
pub(crate) use declarations::{Const, Function, Global, GlobalStorage, Local, LocalKind, VarFlags};
pub(crate) use ids::{ConstId, ExprId, FuncId, GlobalId, LocalId, StmtId};

// ------------------------------------------------------------------------------------------------------------- module

/// A checked translation unit for one pass.
#[derive(Debug, Default)]
pub struct Module {
    pub types: TypeTable,
    pub structs: Vec<Struct>,
    /// In text order; non-constant initialisers run in this order when the entry point starts.
    pub globals: Vec<Global>,
    /// The samplers that a plain shader declares, in text order.
    pub samplers: Vec<GlobalId>,
    /// `gl_FragColor` and `gl_FragData`, if the text of a [`crate::PassKind::Main`] names them.
    pub frag_color: Option<GlobalId>,
    pub frag_data: Option<GlobalId>,
    pub frag_coord: FragCoord,
    /// One entry per signature; prototypes and definition share it.
    pub functions: Vec<Function>,
    pub exprs: Vec<Expr>,
    pub stmts: Vec<Stmt>,
    pub consts: Vec<Const>,
    pub locals: Vec<Local>,
    /// `mainImage` or another entry point, with a body and exactly the signature of the pass's kind. Always set if
    /// there is no error.
    pub entry: Option<FuncId>,
    /// Functions reachable from [`Module::entry`] and from initialisers of used globals, callees before callers (the
    /// checker forbids recursion). Each has a body.
    pub call_order: Vec<FuncId>,
    /// Every resolved name in the text, except declarations, in no particular order; for editors.
    pub uses: Vec<Use>,
    expr_lists: Vec<ExprId>,
    stmt_lists: Vec<StmtId>,
    cases: Vec<Case>,
    /// Pool of [`Const::words`] and [`Case::values`].
    words: Vec<u32>,
    members: Vec<StructMember>,
    tokens: Vec<TokenId>,
}

/// The place in a pixel that `gl_FragCoord` names, by the layout of its declaration.
#[derive(Clone, Copy, Debug, Default)]
pub struct FragCoord {
    /// y grows downwards from the top (`origin_upper_left`).
    pub is_from_top: bool,
    /// It is the lower left corner instead of the centre (`pixel_center_integer`).
    pub is_of_corners: bool,
}

/// Cloning a module allows checking to continue in the copy: the text after Common is checked into it.
impl Clone for Module {
    fn clone(&self) -> Self {
        Self {
            types: self.types.clone(),
            structs: self.structs.clone(),
            globals: self.globals.clone(),
            samplers: self.samplers.clone(),
            frag_color: self.frag_color,
            frag_data: self.frag_data,
            frag_coord: self.frag_coord,
            functions: self.functions.clone(),
            exprs: ast::with_room(&self.exprs),
            stmts: ast::with_room(&self.stmts),
            consts: ast::with_room(&self.consts),
            locals: ast::with_room(&self.locals),
            entry: self.entry,
            call_order: self.call_order.clone(),
            uses: ast::with_room(&self.uses),
            expr_lists: ast::with_room(&self.expr_lists),
            stmt_lists: ast::with_room(&self.stmt_lists),
            cases: ast::with_room(&self.cases),
            words: ast::with_room(&self.words),
            members: ast::with_room(&self.members),
            tokens: ast::with_room(&self.tokens),
        }
    }
}

ast::arenas! { Module;
    ExprId => Expr, exprs;
    StmtId => Stmt, stmts;
    ConstId => Const, consts;
    StructId => Struct, structs;
    LocalId => Local, locals;
    GlobalId => Global, globals;
    FuncId => Function, functions;
    @pools
    ExprId, expr_lists;
    StmtId, stmt_lists;
    Case, cases;
    u32, words;
    StructMember, members;
    TokenId, tokens;
}

impl Module {
    /// Reserves capacity for the nodes of a tree, except for its first `done` expressions.
    pub fn reserve(&mut self, ast: &ast::Ast, done: usize) {
        let exprs = ast.exprs.len() - done;
        self.exprs.reserve(exprs + exprs / 4);
        self.stmts.reserve(ast.stmts.len() - self.stmts.len().min(ast.stmts.len()));
        self.uses.reserve(exprs / 2);
    }

    #[inline]
    pub fn expr(&mut self, expr: Expr) -> ExprId {
        self.exprs.push(expr);
        ExprId::new(self.exprs.len() - 1)
    }

    #[inline]
    pub fn stmt(&mut self, kind: StmtKind, loc: Loc) -> StmtId {
        self.stmts.push(Stmt { kind, loc });
        StmtId::new(self.stmts.len() - 1)
    }

    /// Stores a folded value; for `words` see [`Const::words`].
    pub fn constant(&mut self, ty: TypeId, words: &[u32]) -> ConstId {
        let words = self.list(words);
        self.consts.push(Const { ty, words });
        ConstId::new(self.consts.len() - 1)
    }

    /// Returns a type as GLSL writes it.
    pub fn type_text(&self, names: &ast::Interner, ty: TypeId) -> String {
        match self.types.get(ty) {
            Type::Array { element, len } => types::array_text(&self.type_text(names, element), &len.to_string()),
            Type::Struct(id) => match self[id].name {
                Some(name) => names.get(name.symbol).to_owned(),
                None => "struct {..}".to_owned(),
            },
            _ => ty.as_basic().map_or("?", ast::BasicType::name).to_owned(),
        }
    }

    /// Returns the parameters of a function, in order.
    #[inline]
    pub fn params(&self, func: FuncId) -> &[Local] {
        let function = &self[func];
        &self.locals[function.locals.start as usize..][..function.param_count as usize]
    }

    /// Adds the operands of an expression.
    pub fn parts(&self, expr: ExprId, out: &mut Vec<ExprId>) {
        match self[expr].kind {
            ExprKind::Error
            | ExprKind::Literal(_)
            | ExprKind::Const(_)
            | ExprKind::Local(_)
            | ExprKind::Global(_)
            | ExprKind::Uniform(_)
            | ExprKind::CustomUniform(_)
            | ExprKind::Channel(_)
            | ExprKind::BuiltinVar(_) => {}
            ExprKind::Member { base: of, .. }
            | ExprKind::Swizzle { base: of, .. }
            | ExprKind::Unary { operand: of, .. }
            | ExprKind::IncDec { place: of, .. }
            | ExprKind::Convert(of)
            | ExprKind::Splat(of)
            | ExprKind::MatrixDiagonal(of)
            | ExprKind::MatrixResize(of) => out.push(of),
            ExprKind::Index { base: a, index: b }
            | ExprKind::Binary { lhs: a, rhs: b, .. }
            | ExprKind::Comma { lhs: a, rhs: b }
            | ExprKind::Assign { place: a, value: b }
            | ExprKind::AssignOp { place: a, value: b, .. }
            | ExprKind::Logical { lhs: a, rhs: b, .. } => out.extend([a, b]),
            ExprKind::Ternary { cond, then, otherwise } => out.extend([cond, then, otherwise]),
            ExprKind::Vector(args)
            | ExprKind::Matrix(args)
            | ExprKind::Struct(args)
            | ExprKind::Array(args)
            | ExprKind::Builtin { args, .. }
            | ExprKind::Call { args, .. } => out.extend(&self[args]),
        }
    }

    /// Returns the variable that is, or contains, a place.
    pub fn root(&self, mut place: ExprId) -> ExprId {
        while let ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } | ExprKind::Index { base, .. } =
            self[place].kind
        {
            place = base;
        }
        place
    }
}

/// A struct type. Member types are complete and not void; names are distinct.
#[derive(Clone, Copy, Debug)]
pub struct Struct {
    /// `None` for `struct { .. } x;`.
    pub name: Option<Ident>,
    pub ty: TypeId,
    pub members: List<StructMember>,
    pub loc: Loc,
}

#[derive(Clone, Copy, Debug)]
pub struct StructMember {
    pub name: Ident,
    pub ty: TypeId,
}

// -------------------------------------------------------------------------------------------------------- expressions

/// A typed expression.
#[derive(Clone, Copy, Debug)]
pub struct Expr {
    pub kind: ExprKind,
    /// Type of the value; `VOID` only for calls (and commas and ternaries of these).
    pub ty: TypeId,
    pub flags: ExprFlags,
    pub loc: Loc,
}

bitflags::bitflags! {
    /// Properties of an expression and its operands.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct ExprFlags: u8 {
        /// May be assigned to. Set for variables that are not constants, inputs or uniforms, and for `Member`, `Index`
        /// and non-repeating `Swizzle` of such. A place is also a value: it is read when used as one.
        const PLACE = 1;
        /// Evaluation may have side effects: an assignment, `++`, a user call, a built-in with `out` argument,
        /// `st_assert`.
        const EFFECTS = 2;
        /// A constant expression (section 4.3.3): always a `Literal` or `Const`.
        const CONSTANT = 8;
    }
}

impl ExprFlags {
    /// Returns the flags that a parent inherits from a child: effects.
    #[must_use]
    pub fn inherited(self) -> Self {
        self & Self::EFFECTS
    }
}

/// The kind of an expression. `ty` below is the expression's own type.
#[derive(Clone, Copy, Debug)]
pub enum ExprKind {
    /// Reported; never reaches lowering.
    Error,

    // Values.
    /// A scalar constant, bit for bit (bool 0 or 1); `ty` is bool, int, uint or float.
    Literal(u32),
    /// A folded vector, matrix, array or struct. All uses of one `const` variable have the same id, so that a table is
    /// stored once.
    Const(ConstId),
    /// A parameter or variable of the current function. One of sampler type is a parameter to which a channel is
    /// passed.
    Local(LocalId),
    /// A variable of storage `Private`, `Uniform`, `In` or `Out`.
    Global(GlobalId),
    /// A Shadertoy uniform. `ty` is [`Uniform::ty`]; the arrays are usually followed by an `Index`.
    Uniform(Uniform),
    /// A custom uniform, by its index among the pass's.
    CustomUniform(u16),
    /// `iChannel0` to `iChannel3` (also `iCh0.sampler`); `ty` is the sampler type. Occurs only as an argument.
    Channel(u8),
    /// A `gl_` variable.
    BuiltinVar(BuiltinVar),

    // Parts.
    /// Member `index` of a struct.
    Member { base: ExprId, index: u32 },
    /// Components of a vector. One component is a scalar.
    Swizzle { base: ExprId, swizzle: Swizzle },
    /// An element of an array, a column of a matrix or a component of a vector. `index` is int or uint; a `Literal` is
    /// in range (the checker guarantees it), any other index is clamped by lowering.
    Index { base: ExprId, index: ExprId },

    // Operators.
    /// Operand and result have the same type. Unary plus has no node.
    Unary { op: UnaryOp, operand: ExprId },
    /// Operators that evaluate both sides.
    Binary { op: BinaryOp, shape: Shape, lhs: ExprId, rhs: ExprId },
    /// `&&` and `||`: the right side is evaluated only if needed.
    Logical { op: LogicalOp, lhs: ExprId, rhs: ExprId },
    /// `cond` is bool; one branch is evaluated; both have type `ty` (which may be void, an array or a struct).
    Ternary { cond: ExprId, then: ExprId, otherwise: ExprId },
    /// Evaluates both; the value is `rhs`. Never a place.
    Comma { lhs: ExprId, rhs: ExprId },
    /// `place = value`, all three types equal (arrays and structs too). The value is the stored one; not a place.
    Assign { place: ExprId, value: ExprId },
    /// `place op= value`: the place is evaluated once, before `value`, and read after it. `ty` and `place` have the
    /// same type; `shape` is that of `place op value`.
    AssignOp { op: BinaryOp, shape: Shape, place: ExprId, value: ExprId },
    /// `++` and `--` on int, uint or float scalars, vectors or matrices; the value is the new one for prefix, the old
    /// for postfix. Not a place.
    IncDec { op: IncDec, place: ExprId },

    // Constructors (section 5.4). Component types agree unless stated otherwise: the checker wraps arguments in
    // `Convert`. `float(v)`, `vec2(v3)` and the like are a `Swizzle` (or `Index`) and a `Convert`; a constructor of the
    // same type has no node.
    /// Component by component between bool, int, uint and float (section 5.4.1), of a scalar or vector of the same
    /// size, to a different component type. Never of a matrix: `ivec4(m)` is the `Convert` of a float `Vector` of `m`.
    Convert(ExprId),
    /// A vector from one scalar.
    Splat(ExprId),
    /// A vector from scalars, vectors and matrices: the first `size` of their components in order (matrices column by
    /// column). At least two arguments or a matrix; no argument is wholly unused. Component types are those of `ty`.
    Vector(List<ExprId>),
    /// A matrix with a float scalar on its diagonal and zeros elsewhere.
    MatrixDiagonal(ExprId),
    /// A matrix from one of another shape: the common part is copied, the rest is that of the identity matrix.
    MatrixResize(ExprId),
    /// A matrix from float scalars and vectors, column by column: exactly as many components as it has, or more in the
    /// last argument.
    Matrix(List<ExprId>),
    /// A struct, one argument per member, of exactly the members' types.
    Struct(List<ExprId>),
    /// An array, one argument per element, of exactly the element type.
    Array(List<ExprId>),

    // Calls.
    /// A user function: one argument per parameter ([`Module::params`]), with equal types. An argument to `out` or
    /// `inout` is a place: it is evaluated (including its indices) in argument order before the call, and copied back
    /// in argument order after it. A sampler argument is a `Channel` or a `Local`.
    Call { func: FuncId, args: List<ExprId> },
    /// A built-in: argument and result types are those of one overload of chapter 8, which they identify. `modf`'s
    /// second argument is a place. Texture calls have the sampler first; constant offsets are `Literal`/`Const` in the
    /// legal range.
    Builtin { builtin: Builtin, args: List<ExprId> },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnaryOp {
    /// int, uint, float; scalars, vectors, matrices.
    Negate,
    /// bool.
    Not,
    /// int, uint; scalars, vectors.
    BitNot,
}

/// Operators that always evaluate both sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOp {
    /// Ints wrap.
    Add,
    Sub,
    Mul,
    /// Int division truncates; division by zero, and of the most negative int by -1, are undefined but must not trap.
    Div,
    /// int and uint only.
    Rem,
    BitAnd,
    BitOr,
    BitXor,
    /// The right side may be uint for an int left side and vice versa.
    Shl,
    /// Arithmetic for int, logical for uint (by the left side).
    Shr,
    /// The four relational operators: int, uint or float scalars; bool result.
    Less,
    Greater,
    LessEqual,
    GreaterEqual,
    /// Whole values of one type, any except void and samplers (`lhs`'s `ty`): bool result, true if all parts are equal.
    Equal,
    /// The opposite of `Equal`: true if any part differs.
    NotEqual,
    /// `^^` on bools.
    LogicalXor,
}

/// The way in which the operand types of a [`BinaryOp`] combine. Relational operators, equality and `^^` are always
/// `Same`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// Equal types, component by component (for shifts: equal sizes). Never `Mul` of two matrices.
    Same,
    /// Scalar left, vector or matrix right: the scalar is combined with each component.
    ScalarLeft,
    /// Vector or matrix left, scalar right.
    ScalarRight,
    /// `Mul`: `matCxR * vecC = vecR`.
    MatVec,
    /// `Mul`: `vecR * matCxR = vecC`.
    VecMat,
    /// `Mul`: `matKxR * matCxK = matCxR`.
    MatMat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LogicalOp {
    And,
    Or,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum IncDec {
    PreIncrement,
    PreDecrement,
    PostIncrement,
    PostDecrement,
}

// --------------------------------------------------------------------------------------------------------- statements

/// A statement. Empty statements, `const` declarations and struct definitions have none.
#[derive(Clone, Copy, Debug)]
pub struct Stmt {
    pub kind: StmtKind,
    pub loc: Loc,
}

/// The kind of a statement. Scopes are resolved, so a `Block` only groups.
#[derive(Clone, Copy, Debug)]
pub enum StmtKind {
    /// Statements that run in sequence.
    Block(List<StmtId>),
    /// Evaluated for its effects.
    Expr(ExprId),
    /// One variable of a declaration. Each execution sets it again: to `init`, or to zero.
    Declare { local: LocalId, init: Option<ExprId> },
    /// `cond` is bool.
    If { cond: ExprId, then: List<StmtId>, otherwise: List<StmtId> },
    /// `for` and (with nothing in `init` and `step`) `while`. `init` runs once; `test` (bool; true if absent) before
    /// each iteration; `step` after each, also after `continue`. A condition that declares a variable, `while (bool b =
    /// e)`, is an `Assign` to `b` as `test`.
    For { init: List<StmtId>, test: Option<ExprId>, step: Option<ExprId>, body: List<StmtId> },
    /// `continue` jumps to the test.
    DoWhile { body: List<StmtId>, test: ExprId },
    /// `value` is int or uint, evaluated once.
    Switch { value: ExprId, cases: List<Case> },
    /// `Some` in functions that return a value, of type `Function::result`; `None` otherwise, and where a void call is
    /// returned.
    Return(Option<ExprId>),
    /// Leaves the nearest loop or switch; the checker guarantees that there is one.
    Break,
    /// Continues the nearest loop, also from within a switch.
    Continue,
    /// Ends the invocation, which then writes nothing.
    Discard,
}

/// Consecutive labels and the statements after them, up to the next label. Control falls through into the next case
/// unless the body ends with `break` or the like. Locals declared in one case may be used in later ones: where the
/// declaration was skipped they have any value, preferably zero.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Bits of the `case` values; distinct within a switch (the checker guarantees it).
    pub values: List<u32>,
    /// `default:` is among the labels; at most once per switch, at any position.
    pub is_default: bool,
    pub body: List<StmtId>,
    /// The labels.
    pub loc: Loc,
}

// ------------------------------------------------------------------------------------------------------- side tables

/// A name in the text and what it refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// `Origins` stores where it is written, which may be inside a macro's definition.
    pub token: TokenId,
    pub target: DeclRef,
}

/// The targets that a name can refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DeclRef {
    Local(LocalId),
    Global(GlobalId),
    Func(FuncId),
    Struct(StructId),
    Member(StructId, u32),
    Builtin(Builtin),
    BuiltinVar(BuiltinVar),
    /// A `gl_Max..` constant.
    BuiltinConst(Symbol),
    Uniform(Uniform),
    CustomUniform(u16),
    /// `iChannel0` to `iChannel3`.
    Channel(u8),
    /// `iCh0` to `iCh3`.
    ChannelStruct(u8),
}

const _: () = assert!(size_of::<Expr>() <= 32 && size_of::<Stmt>() <= 36 && size_of::<Type>() <= 12);
