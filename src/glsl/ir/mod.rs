//! The intermediate representation: a program between the checked tree (`hir`) and the module of a graphics
//! API.
//!
//! Owns its data ([`Module`], [`Function`], [`Op`]), the types of values ([`infer`]), the text form ([`print`]), the
//! walk by which passes rewrite functions ([`rewrite`]), and [`verify`], which checks the rules that can be checked
//! statically. Knows neither where programs come from nor what they become.
//!
//! The form is structured SSA over memory:
//! - A [`Value`] is computed once, by the [`Op`] that it names, at its [`Stmt::Let`]. It may be used wherever that
//!   statement dominates: later in the same block, and in nested blocks.
//! - Constants, inputs and addresses of variables are *free* ([`Op::is_free`]): no statement computes them, and they
//!   may be used everywhere in their function.
//! - A variable is memory. [`Op::Load`] reads it, [`Stmt::Store`] writes it. There are no phis: a value that differs
//!   between two control-flow paths is kept in a variable.
//! - A *place* is an address: a variable, or a part of one. [`Op::Part`] and [`Op::Element`] of a place are places.
//!   Places are operands of loads, stores, calls and of these two only.
//! - Control flow is structured: [`Stmt::If`], [`Stmt::Loop`], [`Stmt::Switch`] contain blocks.
//!
//! All integers wrap; a divisor is never zero, nor -1 where the quotient would overflow; an index is always in range.
//! Lowering guarantees this, and each pass preserves it; [`verify`] cannot check it. So a program can be run, by a
//! device or step by step on the processor.

pub mod analysis;
mod compact;
mod ids;
pub mod infer;
pub mod layout;
mod op;
pub mod print;
pub mod rewrite;
pub mod verify;

pub use ids::{ConstId, FuncId, GlobalId, Value, VarId};
pub use op::{Axis, Binary, Detail, Input, Level, Math, Op, Unary};

use super::{
    ast::Loc,
    builtins::{Builtin, Uniform},
    types::{SamplerDim, Scalar, TypeId, TypeTable},
};

/// A program: functions, and the memory that they share.
#[derive(Clone, Debug, Default)]
pub struct Module {
    pub types: TypeTable,
    /// Types of the members of each structure, by [`StructId`](super::types::StructId).
    pub structs: Vec<Vec<TypeId>>,
    pub consts: Vec<Const>,
    pub globals: Vec<Global>,
    /// The textures that operations read, by their `channel`.
    pub textures: Vec<Texture>,
    /// The uniform buffers that a plain shader declares.
    pub blocks: Vec<UniformBlock>,
    /// The names of structures; only in a plain shader.
    pub struct_names: Vec<StructNames>,
    /// Callees before their callers; the last is the entry point.
    pub functions: Vec<Function>,
}

/// A texture and its sampler.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The author's name; empty for a channel.
    pub name: String,
    pub dim: SamplerDim,
    /// The component type of a read: float, int or uint.
    pub scalar: Scalar,
    /// Reads compare a depth, and return the share of texels that pass.
    pub shadow: bool,
    pub group: u32,
    /// Binding of the texture; that of the sampler follows.
    pub binding: u32,
}

/// The names of a structure and its members; empty if it has none.
#[derive(Clone, Debug, Default)]
pub struct StructNames {
    pub name: String,
    pub members: Vec<String>,
}

/// A uniform buffer, laid out by the rules of std140 (section 2.12.6.4 of the OpenGL ES 3.0 specification).
#[derive(Clone, Debug)]
pub struct UniformBlock {
    /// The author's name; empty for the uniforms outside of blocks.
    pub name: String,
    pub group: u32,
    pub binding: u32,
    pub members: Vec<BlockMember>,
}

/// A member of a [`UniformBlock`].
#[derive(Clone, Debug)]
pub struct BlockMember {
    pub name: String,
    pub ty: TypeId,
}

/// A constant vector, matrix, array or structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Const {
    pub ty: TypeId,
    /// All scalars in memory order, 32 bits each: floats and ints bit for bit, bools 0 or 1; matrices column by column,
    /// structures member by member.
    pub words: Vec<u32>,
}

/// A variable of the module.
#[derive(Clone, Copy, Debug)]
pub struct Global {
    pub ty: TypeId,
    pub kind: GlobalKind,
}

/// The storage of a variable of the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GlobalKind {
    /// Memory of one invocation, initialised with this constant, or with zeros.
    Private(Option<ConstId>),
    /// One of Shadertoy's uniforms: read only.
    Uniform(Uniform),
    /// The words, a `uvec4`, of the custom uniform in this slot: read only.
    CustomUniform(u16),
    /// Face of the cube map that is being drawn, 0 to 5: read only.
    CubeFace,
    /// The column and the row of the target's first texel in the picture, an `ivec2`: read only.
    TileOrigin,
    /// A constant that is indexed at run time: read only.
    Table(ConstId),
    /// A member of one of [`Module::blocks`]: read only.
    Member { block: u16, index: u16 },
}

impl GlobalKind {
    /// Returns whether it is never written.
    pub fn is_read_only(self) -> bool {
        !matches!(self, GlobalKind::Private { .. })
    }
}

/// A function.
#[derive(Clone, Debug, Default)]
pub struct Function {
    pub params: Vec<Param>,
    pub result: TypeId,
    pub vars: Vec<Var>,
    pub body: Block,
    /// By [`Value::index`].
    nodes: Vec<Node>,
}

/// A value: the operation that computes it, its type, and its origin.
#[derive(Clone, Debug)]
struct Node {
    op: Op,
    ty: TypeId,
    origin: Origin,
}

/// The part of the author's program that a value is computed for. Passes preserve it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    pub loc: Loc,
    /// The built-in function that the operation belongs to: the call became one operation or several.
    pub builtin: Option<Builtin>,
}

impl From<Loc> for Origin {
    fn from(loc: Loc) -> Self {
        Self { loc, builtin: None }
    }
}

/// A parameter.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    pub ty: TypeId,
    /// The address of a variable of the caller's that is not accessible in any other way.
    pub by_reference: bool,
}

/// A variable of a function.
#[derive(Clone, Copy, Debug)]
pub struct Var {
    pub ty: TypeId,
    /// A constant that is its value whenever the function starts; without one it is written before it is read.
    pub init: Option<Value>,
}

/// Statements that run in order.
pub type Block = Vec<Stmt>;

/// A statement.
#[derive(Clone, Debug)]
pub enum Stmt {
    /// Computes a value.
    Let(Value),
    /// Writes a value to a place.
    Store { place: Value, value: Value },
    /// Runs one of two blocks.
    If { condition: Value, accept: Block, reject: Block },
    /// Runs `body`, then `continuing`, until a `Break`, or until `break_if` is true after `continuing`.
    Loop { body: Block, continuing: Block, break_if: Option<Value> },
    /// Runs the case that has the selector's value, or the default.
    Switch { selector: Value, cases: Vec<Case> },
    /// Leaves the innermost loop or switch.
    Break,
    /// Goes to the `continuing` part of the innermost loop.
    Continue,
    /// Ends the function, with its result unless that is void.
    Return(Option<Value>),
    /// Ends the invocation without drawing anything.
    Discard,
    /// Ends the entry point with these outputs.
    Output(Vec<(Output, Value)>),
}

impl Stmt {
    /// Visits the operands of the statement itself, in order, except those of the op of a `Let`.
    pub fn operands(&self, mut visit: impl FnMut(Value)) {
        match self {
            Stmt::Store { place, value } => {
                visit(*place);
                visit(*value);
            }
            Stmt::If { condition: value, .. } | Stmt::Switch { selector: value, .. } => visit(*value),
            Stmt::Loop { break_if: value, .. } | Stmt::Return(value) => value.iter().copied().for_each(visit),
            Stmt::Output(parts) => parts.iter().for_each(|(_, value)| visit(*value)),
            Stmt::Let(_) | Stmt::Break | Stmt::Continue | Stmt::Discard => {}
        }
    }

    /// Visits the operands of the statement itself, in order; each may be changed. The operands of the op of a `Let`
    /// are not visited.
    pub fn operands_mut(&mut self, mut visit: impl FnMut(&mut Value)) {
        match self {
            Stmt::Store { place, value } => {
                visit(place);
                visit(value);
            }
            Stmt::If { condition: value, .. } | Stmt::Switch { selector: value, .. } => visit(value),
            Stmt::Loop { break_if: value, .. } | Stmt::Return(value) => value.iter_mut().for_each(visit),
            Stmt::Output(parts) => parts.iter_mut().for_each(|(_, value)| visit(value)),
            Stmt::Let(_) | Stmt::Break | Stmt::Continue | Stmt::Discard => {}
        }
    }

    /// Visits the nested blocks, in order.
    pub fn blocks<'a>(&'a self, mut visit: impl FnMut(&'a Block)) {
        match self {
            Stmt::If { accept: a, reject: b, .. } | Stmt::Loop { body: a, continuing: b, .. } => {
                visit(a);
                visit(b);
            }
            Stmt::Switch { cases, .. } => cases.iter().for_each(|case| visit(&case.body)),
            _ => {}
        }
    }

    /// Returns whether a condition is true for some nested block.
    pub fn any_block(&self, mut condition: impl FnMut(&Block) -> bool) -> bool {
        let mut found = false;
        self.blocks(|block| found = found || condition(block));
        found
    }

    /// Returns a copy with other nested blocks.
    pub fn with_blocks(&self, mut copy: impl FnMut(&Block) -> Block) -> Stmt {
        match self {
            &Stmt::If { condition, ref accept, ref reject } => {
                Stmt::If { condition, accept: copy(accept), reject: copy(reject) }
            }
            &Stmt::Loop { ref body, ref continuing, break_if } => {
                Stmt::Loop { body: copy(body), continuing: copy(continuing), break_if }
            }
            Stmt::Switch { selector, cases } => {
                let cases = cases.iter().map(|case| Case { body: copy(&case.body), ..*case }).collect();
                Stmt::Switch { selector: *selector, cases }
            }
            other => other.clone(),
        }
    }

    /// Visits the nested blocks, in order; each may be changed.
    pub fn blocks_mut(&mut self, mut visit: impl FnMut(&mut Block)) {
        match self {
            Stmt::If { accept: a, reject: b, .. } | Stmt::Loop { body: a, continuing: b, .. } => {
                visit(a);
                visit(b);
            }
            Stmt::Switch { cases, .. } => cases.iter_mut().for_each(|case| visit(&mut case.body)),
            _ => {}
        }
    }
}

/// A case of a [`Stmt::Switch`].
#[derive(Clone, Debug)]
pub struct Case {
    /// Bits of an int or uint; none for the default.
    pub label: Option<u32>,
    pub body: Block,
    /// The body is empty, and control continues with the next case.
    pub falls_through: bool,
}

/// A part of the result of an entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// A target of a fragment stage.
    Target(u32),
    /// A vertex output for the fragment stage.
    Varying { location: u32, flat: bool },
    /// The position of a vertex, in clip space.
    Position,
    /// The depth of a fragment.
    Depth,
}

impl Function {
    /// Returns an empty function.
    pub fn new(result: TypeId) -> Self {
        Self { result, ..Self::default() }
    }

    /// Reserves capacity for this number of additional values.
    pub fn reserve(&mut self, values: usize) {
        self.nodes.reserve(values);
    }

    /// Appends an op: a free one, or one for a statement to compute.
    pub fn append(&mut self, op: Op, ty: TypeId, origin: impl Into<Origin>) -> Value {
        self.nodes.push(Node { op, ty, origin: origin.into() });
        Value::new(self.nodes.len() - 1)
    }

    /// Replaces the op that computes a value and returns the old one. The type stays the same.
    pub fn replace(&mut self, value: Value, op: Op) -> Op {
        std::mem::replace(&mut self.nodes[value.index()].op, op)
    }

    /// Returns the type of a value, or of the contents of a place.
    pub fn ty(&self, value: Value) -> TypeId {
        self.nodes[value.index()].ty
    }

    /// Returns the source range that a value is computed for.
    pub fn loc(&self, value: Value) -> Loc {
        self.origin(value).loc
    }

    /// Returns the origin of a value.
    pub fn origin(&self, value: Value) -> Origin {
        self.nodes[value.index()].origin
    }

    /// Returns the number of values.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns all values, computed or not.
    pub fn values(&self) -> impl Iterator<Item = (Value, &Op)> {
        self.nodes.iter().enumerate().map(|(i, node)| (Value::new(i), &node.op))
    }

    pub fn add_var(&mut self, ty: TypeId) -> VarId {
        self.vars.push(Var { ty, init: None });
        VarId::new(self.vars.len() - 1)
    }

    /// Returns the variable, parameter or global that a place is, or is a part of.
    pub fn root(&self, mut place: Value) -> Value {
        while let Op::Part { base, .. } | Op::Element { base, .. } = self[place] {
            place = base;
        }
        place
    }

    /// Returns whether a value is an address.
    pub fn is_place(&self, value: Value) -> bool {
        match self[self.root(value)] {
            Op::Var(_) | Op::Global(_) => true,
            Op::Param(index) => self.params[index as usize].by_reference,
            _ => false,
        }
    }
}

impl std::ops::Index<Value> for Function {
    type Output = Op;

    fn index(&self, value: Value) -> &Op {
        &self.nodes[value.index()].op
    }
}

impl Module {
    pub fn add_global(&mut self, ty: TypeId, kind: GlobalKind) -> GlobalId {
        self.globals.push(Global { ty, kind });
        GlobalId::new(self.globals.len() - 1)
    }

    /// Returns the type of a texel of a channel, or of a comparison with one.
    pub fn texel(&self, channel: u8) -> TypeId {
        match self.textures.get(usize::from(channel)) {
            Some(Texture { shadow: true, .. }) => TypeId::FLOAT,
            Some(texture) => TypeId::vector(texture.scalar, 4),
            None => TypeId::VEC4,
        }
    }

    /// Returns the number of statements of each function with all calls inlined, by [`FuncId::index`].
    pub fn inlined_sizes(&self) -> Vec<u64> {
        fn add(f: &Function, block: &Block, sizes: &[u64]) -> u64 {
            let mut sum = block.len() as u64;
            for stmt in block {
                if let Stmt::Let(value) = stmt
                    && let Op::Call { function, .. } = f[*value]
                {
                    sum = sum.saturating_add(sizes[function.index()]);
                }
                stmt.blocks(|block| sum = sum.saturating_add(add(f, block, sizes)));
            }
            sum
        }
        let mut sizes = Vec::with_capacity(self.functions.len());
        for function in &self.functions {
            sizes.push(add(function, &function.body, &sizes));
        }
        sizes
    }

    /// Drops functions that are no longer called.
    pub fn drop_uncalled(&mut self) {
        let mut called = vec![false; self.functions.len()];
        let Some(entry) = called.last_mut() else { return };
        *entry = true;
        for (index, function) in self.functions.iter().enumerate().rev() {
            let nodes = if called[index] { &function.nodes[..] } else { &[] };
            for Node { op, .. } in nodes {
                if let Op::Call { function, .. } = op {
                    called[function.index()] = true;
                }
            }
        }
        let mut kept = 0;
        let number = |&called: &bool| {
            kept += usize::from(called);
            called.then(|| FuncId::new(kept - 1))
        };
        let new: Vec<_> = called.iter().map(number).collect();
        let mut called = called.into_iter();
        self.functions.retain(|_| called.next() == Some(true));
        for function in &mut self.functions {
            for Node { op, .. } in &mut function.nodes {
                if let Op::Call { function, .. } = op {
                    *function = new[function.index()].expect("a called function is kept");
                }
            }
        }
    }

    /// Returns the number of parts of a type: components, columns, elements, members. A scalar has none.
    pub fn extent(&self, ty: TypeId) -> u32 {
        use super::types::Type;
        match self.types.get(ty) {
            Type::Vector { size, .. } => size.into(),
            Type::Matrix { columns, .. } => columns.into(),
            Type::Array { len, .. } => len,
            Type::Struct(id) => self.structs[id.index()].len() as u32,
            _ => 0,
        }
    }

    /// Returns the type of a part.
    pub fn part(&self, ty: TypeId, index: u32) -> TypeId {
        use super::types::Type;
        match self.types.get(ty) {
            Type::Struct(id) => self.structs[id.index()][index as usize],
            _ => self.types.element(ty).expect("only what has parts is taken apart"),
        }
    }

    /// Returns whether a type contains a float.
    pub fn contains_floats(&self, ty: TypeId) -> bool {
        use super::types::Type;
        match self.types.get(ty) {
            Type::Array { element, .. } => self.contains_floats(element),
            Type::Struct(id) => self.structs[id.index()].iter().any(|&member| self.contains_floats(member)),
            _ => self.types.scalar(ty) == Some(Scalar::Float),
        }
    }

    /// Returns the component type of a scalar, vector or matrix.
    pub fn scalar(&self, ty: TypeId) -> Scalar {
        self.types.scalar(ty).expect("a scalar, vector or matrix")
    }
}

impl std::ops::Index<ConstId> for Module {
    type Output = Const;

    fn index(&self, id: ConstId) -> &Const {
        &self.consts[id.index()]
    }
}

impl std::ops::Index<GlobalId> for Module {
    type Output = Global;

    fn index(&self, id: GlobalId) -> &Global {
        &self.globals[id.index()]
    }
}

impl std::ops::Index<FuncId> for Module {
    type Output = Function;

    fn index(&self, id: FuncId) -> &Function {
        &self.functions[id.index()]
    }
}
