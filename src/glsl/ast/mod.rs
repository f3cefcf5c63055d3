//! The syntax tree of one translation unit (Common and the pass's text, after preprocessing).
//!
//! Plain data in arenas: every node is a small `Copy` value in a `Vec` of [`Ast`], named by a 4-byte id; child lists
//! are [`List`]s, ranges of shared pools. Nothing is boxed, so dropping never recurses and parsing allocates a handful
//! of times.
//!
//! The parser guarantees the following invariants:
//! - Ids are in post-order: a child's id is smaller than its parent's, in each arena, and each node has one parent.
//!   The expressions of one full expression are contiguous, so types can be found in one loop over the arena, without
//!   recursion.
//! - Nesting is limited to [`MAX_NESTING`] along any path from the root, statements and expressions counted together.
//!   Not counted are the left spines `Binary.lhs`, `Comma.lhs`, `Index.base`, `Member.base`, `Method.base` and
//!   `Postfix.operand`: chains of 10,000 terms are legal, so a walker descends these with a loop, never with a call.
//! - A tree exists for any input. An `Error` node marks text that was not understood. Its diagnostic has been reported:
//!   errors that involve an `Error` node are not reported again.
//! - Every [`Loc`] names tokens that exist in [`Origins`]; even an empty text has its end-of-file token.

mod arena;
mod names;
mod position;

pub use arena::{List, Pooled};
pub(crate) use arena::{arenas, ids, with_room};
pub use names::{Interner, Symbol};
pub use position::{Expansion, ExpansionId, Ident, Loc, MacroDef, MacroId, Origin, Origins, TokenId};

use std::num::NonZeroU32;

/// The depth to which statements and expressions together may nest (ANGLE's limit in WebGL, too); the parser's error
/// names it.
pub const MAX_NESTING: u32 = 300;

ids! {
    /// An expression of [`Ast::exprs`].
    ExprId;
    /// A statement of [`Ast::stmts`].
    StmtId;
    /// A declaration of [`Ast::decls`].
    DeclId;
    /// A type as written, of [`Ast::types`].
    TypeSpecId;
    /// A struct definition of [`Ast::structs`].
    StructDefId;
    /// A function header with or without body, of [`Ast::functions`].
    FunctionDeclId;
}

// --------------------------------------------------------------------------------------------------------------- tree

/// One translation unit. Arenas and pools are `pub` for reading; grow them through [`Ast::expr`], [`Ast::list`] and so
/// on.
#[derive(Debug, Default)]
pub struct Ast {
    /// External declarations in text order: Common's, then the pass's. Prototypes and definitions are separate entries.
    pub items: Vec<DeclId>,
    pub exprs: Vec<Expr>,
    pub stmts: Vec<Stmt>,
    pub decls: Vec<Decl>,
    pub types: Vec<TypeSpec>,
    pub structs: Vec<StructDef>,
    pub functions: Vec<FunctionDecl>,
    expr_lists: Vec<ExprId>,
    stmt_lists: Vec<StmtId>,
    dims: Vec<Dim>,
    qualifiers: Vec<Qualifier>,
    layout: Vec<LayoutItem>,
    declarators: Vec<Declarator>,
    params: Vec<Param>,
    fields: Vec<Field>,
    idents: Vec<Ident>,
}

/// The clone has spare capacity: the text that follows Common is parsed into it.
impl Clone for Ast {
    fn clone(&self) -> Self {
        Self {
            items: with_room(&self.items),
            exprs: with_room(&self.exprs),
            stmts: with_room(&self.stmts),
            decls: with_room(&self.decls),
            types: with_room(&self.types),
            structs: with_room(&self.structs),
            functions: with_room(&self.functions),
            expr_lists: with_room(&self.expr_lists),
            stmt_lists: with_room(&self.stmt_lists),
            dims: with_room(&self.dims),
            qualifiers: with_room(&self.qualifiers),
            layout: with_room(&self.layout),
            declarators: with_room(&self.declarators),
            params: with_room(&self.params),
            fields: with_room(&self.fields),
            idents: with_room(&self.idents),
        }
    }
}

arenas! { Ast;
    ExprId => Expr, exprs;
    StmtId => Stmt, stmts;
    DeclId => Decl, decls;
    TypeSpecId => TypeSpec, types;
    StructDefId => StructDef, structs;
    FunctionDeclId => FunctionDecl, functions;
    @pools
    ExprId, expr_lists;
    StmtId, stmt_lists;
    Dim, dims;
    Qualifier, qualifiers;
    LayoutItem, layout;
    Declarator, declarators;
    Param, params;
    Field, fields;
    Ident, idents;
}

impl Ast {
    #[inline]
    pub fn expr(&mut self, kind: ExprKind, loc: Loc) -> ExprId {
        self.exprs.push(Expr { kind, loc });
        ExprId::new(self.exprs.len() - 1)
    }

    /// Calls `visit` for each direct subexpression, in text order.
    pub fn parts(&self, expr: ExprId, mut visit: impl FnMut(ExprId)) {
        match self[expr].kind {
            ExprKind::Error
            | ExprKind::Int(_)
            | ExprKind::Uint(_)
            | ExprKind::Float(_)
            | ExprKind::Bool(_)
            | ExprKind::Name(_) => {}
            ExprKind::Call { args, .. } => self[args].iter().copied().for_each(visit),
            ExprKind::Construct { ty, args } => {
                self[self[ty].dims].iter().filter_map(|dim| dim.size).for_each(&mut visit);
                self[args].iter().copied().for_each(visit);
            }
            ExprKind::Method { base: of, .. }
            | ExprKind::Member { base: of, .. }
            | ExprKind::Unary { operand: of, .. }
            | ExprKind::Postfix { operand: of, .. } => visit(of),
            ExprKind::Index { base: a, index: b }
            | ExprKind::Binary { lhs: a, rhs: b, .. }
            | ExprKind::Comma { lhs: a, rhs: b }
            | ExprKind::Assign { place: a, value: b, .. } => [a, b].into_iter().for_each(visit),
            ExprKind::Ternary { cond, then, otherwise } => [cond, then, otherwise].into_iter().for_each(visit),
        }
    }

    #[inline]
    pub fn stmt(&mut self, kind: StmtKind, loc: Loc) -> StmtId {
        self.stmts.push(Stmt { kind, loc });
        StmtId::new(self.stmts.len() - 1)
    }

    #[inline]
    pub fn decl(&mut self, kind: DeclKind, loc: Loc) -> DeclId {
        self.decls.push(Decl { kind, loc });
        DeclId::new(self.decls.len() - 1)
    }

    #[inline]
    pub fn type_spec(&mut self, spec: TypeSpec) -> TypeSpecId {
        self.types.push(spec);
        TypeSpecId::new(self.types.len() - 1)
    }

    #[inline]
    pub fn struct_def(&mut self, def: StructDef) -> StructDefId {
        self.structs.push(def);
        StructDefId::new(self.structs.len() - 1)
    }

    #[inline]
    pub fn function(&mut self, function: FunctionDecl) -> FunctionDeclId {
        self.functions.push(function);
        FunctionDeclId::new(self.functions.len() - 1)
    }
}

// -------------------------------------------------------------------------------------------------------- expressions

/// An expression (section 5).
#[derive(Clone, Copy, Debug)]
pub struct Expr {
    pub kind: ExprKind,
    pub loc: Loc,
}

/// The kind of an expression. Parentheses have no node.
#[derive(Clone, Copy, Debug)]
pub enum ExprKind {
    /// Could not be parsed; reported. It has the error type, which silences all further checks.
    Error,
    /// `12`, `0x1F`, `017`: the 32 bits as ESSL 4.1.3 reads them (`0xFFFFFFFF` is -1). The lexer reports literals that
    /// do not fit.
    Int(i32),
    /// `12u`.
    Uint(u32),
    /// `1.5`, `1e3`, `.5f`, rounded to nearest; too large is infinity.
    Float(f32),
    /// `true` or `false`.
    Bool(bool),
    /// A variable, or a name that turns out to be something else (the checker reports it).
    Name(Symbol),
    /// `name(args)`: a function or, as the checker resolves it, a struct's constructor. The name is token `loc.first`.
    Call { name: Symbol, args: List<ExprId> },
    /// A constructor spelled with a type keyword or with array dimensions: `vec3(..)`, `float[](..)`, `S[2](..)`.
    Construct { ty: TypeSpecId, args: List<ExprId> },
    /// `base.name(args)`; only `.length()` is legal, which the checker checks. The name is an `Ident` because it is not
    /// `loc.last`.
    Method { base: ExprId, name: Ident },
    /// `base.name`, member or swizzle. The name is token `loc.last`.
    Member { base: ExprId, name: Symbol },
    /// `base[index]`.
    Index { base: ExprId, index: ExprId },
    /// Prefix operators, including `++x` and `--x`.
    Unary { op: UnaryOp, operand: ExprId },
    /// `x++`, `x--`.
    Postfix { op: PostfixOp, operand: ExprId },
    /// Left-associative; the left spine may be of any length.
    Binary { op: BinaryOp, lhs: ExprId, rhs: ExprId },
    /// `place = value`, or `place op= value` with the operator (arithmetic, shift or bitwise only).
    Assign { op: Option<BinaryOp>, place: ExprId, value: ExprId },
    /// `cond ? then : otherwise`.
    Ternary { cond: ExprId, then: ExprId, otherwise: ExprId },
    /// `lhs, rhs` as an operator (never an argument list). The left spine may be of any length.
    Comma { lhs: ExprId, rhs: ExprId },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnaryOp {
    Plus,
    Minus,
    /// `!`
    Not,
    /// `~`
    BitNot,
    /// `++x`
    Increment,
    /// `--x`
    Decrement,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PostfixOp {
    Increment,
    Decrement,
}

/// Binary operators as written; the operation depends on the operand types (`hir::BinaryOp`, `hir::Shape`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOp {
    Mul,
    Div,
    Rem,
    Add,
    Sub,
    Shl,
    Shr,
    Less,
    Greater,
    LessEqual,
    GreaterEqual,
    Equal,
    NotEqual,
    BitAnd,
    BitXor,
    BitOr,
    LogicalAnd,
    LogicalXor,
    LogicalOr,
}

impl BinaryOp {
    /// Returns the operator as the author wrote it, for messages.
    pub fn text(self) -> &'static str {
        match self {
            BinaryOp::Mul => "*",
            BinaryOp::Div => "/",
            BinaryOp::Rem => "%",
            BinaryOp::Add => "+",
            BinaryOp::Sub => "-",
            BinaryOp::Shl => "<<",
            BinaryOp::Shr => ">>",
            BinaryOp::Less => "<",
            BinaryOp::Greater => ">",
            BinaryOp::LessEqual => "<=",
            BinaryOp::GreaterEqual => ">=",
            BinaryOp::Equal => "==",
            BinaryOp::NotEqual => "!=",
            BinaryOp::BitAnd => "&",
            BinaryOp::BitXor => "^",
            BinaryOp::BitOr => "|",
            BinaryOp::LogicalAnd => "&&",
            BinaryOp::LogicalXor => "^^",
            BinaryOp::LogicalOr => "||",
        }
    }
}

// --------------------------------------------------------------------------------------------------------- statements

/// A statement (section 6).
#[derive(Clone, Copy, Debug)]
pub struct Stmt {
    pub kind: StmtKind,
    pub loc: Loc,
}

/// The kind of a statement. The checker rejects misplaced ones (`break` outside a loop, `case` outside a switch).
#[derive(Clone, Copy, Debug)]
pub enum StmtKind {
    /// Could not be parsed; reported, and skipped by the checker.
    Error,
    /// `;`
    Empty,
    /// `{ .. }`, a scope. A function's body is also a `Block`; it shares the scope of the parameters (section 4.2.2).
    Block(List<StmtId>),
    /// `a = b;`
    Expr(ExprId),
    /// `float a = 1.0;`
    Decl(DeclId),
    /// Branches may be any statement; one that is not a `Block` still opens a scope.
    If { cond: ExprId, then: StmtId, otherwise: Option<StmtId> },
    /// `init` is an `Expr`, `Decl`, `Empty` or `Error` statement. Names of `init` and `cond` share one scope with the
    /// body (section 6.3).
    For { init: StmtId, cond: Option<Condition>, step: Option<ExprId>, body: StmtId },
    /// `while (cond) body`
    While { cond: Condition, body: StmtId },
    /// `do body while (cond);`
    DoWhile { body: StmtId, cond: ExprId },
    /// The body's statements, including `Case` and `Default` labels.
    Switch { value: ExprId, body: List<StmtId> },
    /// `case value:`, a label that is a statement of its own.
    Case(ExprId),
    /// `default:`
    Default,
    /// `return;` or `return value;`
    Return(Option<ExprId>),
    /// `break;`
    Break,
    /// `continue;`
    Continue,
    /// `discard;`
    Discard,
}

/// The condition of a `for` or `while`.
#[derive(Clone, Copy, Debug)]
pub enum Condition {
    Expr(ExprId),
    /// `while (bool b = ..)`: a [`DeclKind::Vars`] with exactly one declarator that has an initialiser (the parser
    /// guarantees it).
    Decl(DeclId),
}

// ------------------------------------------------------------------------------------------------------- declarations

/// A declaration, outside or inside a function. The parser accepts all kinds in both places; the checker rejects
/// misplaced ones.
#[derive(Clone, Copy, Debug)]
pub struct Decl {
    pub kind: DeclKind,
    pub loc: Loc,
}

#[derive(Clone, Copy, Debug)]
pub enum DeclKind {
    /// Could not be parsed; reported.
    Error,
    /// A stray `;` at file scope (an error in ESSL 3.00 that ANGLE accepts: the parser reports no diagnostic).
    Empty,
    /// Variables: `qualifiers type a, b[2] = ..;`. No declarators: `struct S {..};` or `float;`.
    Vars { qualifiers: List<Qualifier>, ty: TypeSpecId, declarators: List<Declarator> },
    /// `precision highp float;`
    Precision { precision: Precision, ty: TypeSpecId },
    /// `invariant a, b;` and other qualifiers applied to declared names, or (names empty) to nothing: `layout(..)
    /// uniform;`.
    Qualify { qualifiers: List<Qualifier>, names: List<Ident> },
    /// A prototype or a definition.
    Function(FunctionDeclId),
    /// `uniform Block { .. } name[2];` (section 4.3.7).
    Block { qualifiers: List<Qualifier>, name: Ident, fields: List<Field>, instance: Option<Ident>, dims: List<Dim> },
}

/// One name of a [`DeclKind::Vars`], of a struct's field or the like.
#[derive(Clone, Copy, Debug)]
pub struct Declarator {
    pub name: Ident,
    /// Dimensions after the name, outermost first; those of the type come after them. ESSL 3.00 has no arrays of
    /// arrays: the checker counts all of them.
    pub dims: List<Dim>,
    /// `None`: no initialiser (the value is zero). An `Error` expression where one could not be parsed, brace lists
    /// included.
    pub init: Option<ExprId>,
}

/// One pair of brackets.
#[derive(Clone, Copy, Debug)]
pub struct Dim {
    /// `None` for `[]`.
    pub size: Option<ExprId>,
    /// Both brackets.
    pub loc: Loc,
}

/// A qualifier with its location. Lists keep text order and repetitions: the checker checks order (section 4.7),
/// duplicates and combinations.
#[derive(Clone, Copy, Debug)]
pub struct Qualifier {
    pub kind: QualifierKind,
    pub token: TokenId,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QualifierKind {
    Const,
    In,
    Out,
    Inout,
    Uniform,
    Flat,
    Smooth,
    Centroid,
    Invariant,
    /// It has no effect.
    Precise,
    Precision(Precision),
    Layout(List<LayoutItem>),
}

impl QualifierKind {
    /// Returns the position in the order that section 4.7 and the grammar require.
    pub fn rank(self) -> u8 {
        match self {
            QualifierKind::Layout(_) => 0,
            QualifierKind::Invariant => 1,
            QualifierKind::Flat | QualifierKind::Smooth => 2,
            QualifierKind::Centroid => 3,
            QualifierKind::Const => 4,
            QualifierKind::In | QualifierKind::Out | QualifierKind::Inout | QualifierKind::Uniform => 5,
            QualifierKind::Precision(_) => 6,
            QualifierKind::Precise => 7,
        }
    }
}

/// `location = 0` or `std140` in a `layout(..)`.
#[derive(Clone, Copy, Debug)]
pub struct LayoutItem {
    pub name: Ident,
    pub value: Option<ExprId>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    Low,
    Medium,
    High,
}

/// A type as written: `highp` and `const` are qualifiers, not part of it.
#[derive(Clone, Copy, Debug)]
pub struct TypeSpec {
    pub kind: TypeSpecKind,
    /// Dimensions after the type, `float[3]`; outermost first.
    pub dims: List<Dim>,
    pub loc: Loc,
}

#[derive(Clone, Copy, Debug)]
pub enum TypeSpecKind {
    /// Could not be parsed; reported.
    Error,
    /// A keyword.
    Basic(BasicType),
    /// A struct's name. Token `loc.first`.
    Named(Symbol),
    /// A definition in place of a name.
    Struct(StructDefId),
}

/// `struct Name { .. }`, named or not. It is in scope from its closing brace on.
#[derive(Clone, Copy, Debug)]
pub struct StructDef {
    pub name: Option<Ident>,
    pub fields: List<Field>,
    pub loc: Loc,
}

/// One line of a struct or block: `highp float a, b[2];`. Declarators here have no initialiser (the parser reports
/// one).
#[derive(Clone, Copy, Debug)]
pub struct Field {
    pub qualifiers: List<Qualifier>,
    pub ty: TypeSpecId,
    pub declarators: List<Declarator>,
    pub loc: Loc,
}

/// A function's prototype or definition.
#[derive(Clone, Copy, Debug)]
pub struct FunctionDecl {
    /// Qualifiers before the result type: precision is legal; the checker reports all others.
    pub qualifiers: List<Qualifier>,
    pub result: TypeSpecId,
    pub name: Ident,
    /// `(void)` is the empty list.
    pub params: List<Param>,
    /// `None` for a prototype; else a `Block`, or `Error`.
    pub body: Option<StmtId>,
    /// From the first qualifier or type to the closing parenthesis; the whole function is [`Decl::loc`].
    pub header: Loc,
}

/// A parameter. No direction qualifier means `in`.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    pub qualifiers: List<Qualifier>,
    pub ty: TypeSpecId,
    pub name: Option<Ident>,
    /// Dimensions after the name.
    pub dims: List<Dim>,
    pub loc: Loc,
}

/// Declares [`BasicType`] with names; the numbers are the first `hir::TypeId`s.
macro_rules! basic_types {
    ($($name:ident = $text:literal;)*) => {
        /// Types that are keywords (section 4.1). `BasicType as usize + 1` is the index of its `hir::TypeId` (0 is the
        /// error type).
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u8)]
        pub enum BasicType { $($name,)* }

        impl BasicType {
            /// All, in order.
            pub const ALL: &'static [BasicType] = &[$(BasicType::$name),*];

            /// The GLSL spelling; `mat2` is also the name of `mat2x2`, which the lexer maps to the same type.
            pub fn name(self) -> &'static str {
                match self { $(BasicType::$name => $text,)* }
            }
        }
    };
}

basic_types! {
    Void = "void";
    Bool = "bool";
    Bvec2 = "bvec2";
    Bvec3 = "bvec3";
    Bvec4 = "bvec4";
    Int = "int";
    Ivec2 = "ivec2";
    Ivec3 = "ivec3";
    Ivec4 = "ivec4";
    Uint = "uint";
    Uvec2 = "uvec2";
    Uvec3 = "uvec3";
    Uvec4 = "uvec4";
    Float = "float";
    Vec2 = "vec2";
    Vec3 = "vec3";
    Vec4 = "vec4";
    Mat2x2 = "mat2";
    Mat2x3 = "mat2x3";
    Mat2x4 = "mat2x4";
    Mat3x2 = "mat3x2";
    Mat3x3 = "mat3";
    Mat3x4 = "mat3x4";
    Mat4x2 = "mat4x2";
    Mat4x3 = "mat4x3";
    Mat4x4 = "mat4";
    Sampler2D = "sampler2D";
    Sampler3D = "sampler3D";
    SamplerCube = "samplerCube";
    Sampler2DArray = "sampler2DArray";
    Sampler2DShadow = "sampler2DShadow";
    SamplerCubeShadow = "samplerCubeShadow";
    Sampler2DArrayShadow = "sampler2DArrayShadow";
    Isampler2D = "isampler2D";
    Isampler3D = "isampler3D";
    IsamplerCube = "isamplerCube";
    Isampler2DArray = "isampler2DArray";
    Usampler2D = "usampler2D";
    Usampler3D = "usampler3D";
    UsamplerCube = "usamplerCube";
    Usampler2DArray = "usampler2DArray";
    Sampler1D = "sampler1D";
}

const _: () = assert!(size_of::<Expr>() <= 24 && size_of::<Stmt>() <= 32 && size_of::<Origin>() == 16);
const _: () = assert!(size_of::<Option<NonZeroU32>>() == size_of::<Option<ExprId>>());
