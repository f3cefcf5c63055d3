//! The operations of a program, by line and class.
//!
//! Compilers of drivers compute equal operations on equal values once, in a block and in those nested in it, so an
//! operation that repeats an earlier one is not counted. Moves, vectors that are taken apart or composed, and reads and
//! writes of whole variables cost nothing: they are registers.

use super::{CountTable, Line, OpClass, Work};
use crate::{
    PassSource,
    ast::{Loc, Origins},
    ir::{Binary, Block, Function, GlobalId, Math, Module, Op, Stmt, Unary, Value, VarId},
    types::{SamplerDim, Scalar, Type, TypeId},
};
use eddy_diag::SourceId;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// The lines of a pass, and the state of counting its operations.
pub(super) struct Lines<'a> {
    origins: &'a Origins,
    /// The bytes at which the lines of each text start.
    starts: FxHashMap<SourceId, Vec<u32>>,
    /// The lines found so far, each with its number in the order of discovery.
    found: BTreeMap<Line, u32>,
    pub operations: Operations,
}

impl<'a> Lines<'a> {
    pub(super) fn new(source: &PassSource<'_>, origins: &'a Origins) -> Self {
        let included = source.includes.iter().filter_map(|include| include.text.ok());
        let texts = [source.code].into_iter().chain(source.common).chain(included);
        let starts = |text: &str| {
            let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
            [0].into_iter().chain(ends.map(|(at, _)| at as u32 + 1)).collect::<Vec<u32>>()
        };
        let starts = texts.map(|text| (text.id, starts(text.text))).collect();
        Self { origins, starts, found: BTreeMap::new(), operations: Operations::default() }
    }

    /// Returns the line of a location; `None` for code that the author did not write.
    fn line(&mut self, loc: Loc) -> Option<u32> {
        if loc == Loc::default() {
            return None;
        }
        let span = self.origins.span(loc);
        let starts = self.starts.get(&span.source)?;
        let number = starts.partition_point(|start| *start <= span.start) as u32;
        let next = self.found.len() as u32;
        Some(*self.found.entry(Line { source: span.source, number }).or_insert(next))
    }

    /// Adds the operations that compute a value.
    pub(super) fn compute(&mut self, module: &Module, f: &Function, value: Value, work: &mut Vec<Work>) {
        let is_new = self.operations.number(module, f, value);
        let line = self.line(f.loc(value));
        let mut add = |class, count, channel| put(work, Work { line, class, channel, count });
        if is_new {
            cost(module, f, &f[value], value, &mut add);
        } else {
            // The line exists, whatever it costs.
            put(work, Work { line, class: OpClass::Add, channel: None, count: 0 });
        }
    }

    /// Adds a store.
    pub(super) fn store(
        &mut self,
        module: &Module,
        f: &Function,
        (place, value): (Value, Value),
        work: &mut Vec<Work>,
    ) {
        self.operations.store(f, place, value);
        let line = self.line(f.loc(value)).or_else(|| self.line(f.loc(place)));
        let count = if is_indexed(f, place) { scalars(module, f.ty(place)) } else { 0 };
        put(work, Work { line, class: OpClass::ArrayStore, channel: None, count });
    }

    /// Adds branches on a value.
    pub(super) fn branch(&mut self, f: &Function, condition: Value, count: u32, work: &mut Vec<Work>) {
        let line = self.line(f.loc(condition));
        put(work, Work { line, class: OpClass::Branch, channel: None, count });
    }

    /// Adds an iteration of a loop.
    pub(super) fn iteration(&mut self, line: Option<u32>, work: &mut Vec<Work>) {
        put(work, Work { line, class: OpClass::Iteration, channel: None, count: 1 });
    }

    /// Returns the line of a loop with this body: that of the first operation in it.
    pub(super) fn of_loop(&mut self, f: &Function, body: &Block) -> Option<u32> {
        let first = first_loc(f, body)?;
        self.line(first)
    }

    /// Gives the lines their numbers in the order of the texts, and adds them to the table.
    pub(super) fn finish(self, table: &mut CountTable) {
        let mut order = vec![0; self.found.len()];
        for (new, (&line, &old)) in self.found.iter().enumerate() {
            order[old as usize] = new as u32;
            table.lines.push(line);
        }
        let renumber = |line: &mut Option<u32>| *line = line.map(|old| order[old as usize]);
        for block in &mut table.blocks {
            block.work.iter_mut().for_each(|work| renumber(&mut work.line));
            block.work.sort_by_key(|work| (work.line, work.class, work.channel));
        }
        table.loops.iter_mut().for_each(|repeated| renumber(&mut repeated.line));
    }
}

fn first_loc(f: &Function, block: &Block) -> Option<Loc> {
    block.iter().find_map(|stmt| match stmt {
        Stmt::Let(value) | Stmt::Store { value, .. } => Some(f.loc(*value)).filter(|loc| *loc != Loc::default()),
        _ => {
            let mut first = None;
            stmt.blocks(|inner| first = first.or_else(|| first_loc(f, inner)));
            first
        }
    })
}

fn put(work: &mut Vec<Work>, new: Work) {
    let same = |old: &&mut Work| (old.line, old.class, old.channel) == (new.line, new.class, new.channel);
    match work.iter_mut().rev().find(same) {
        Some(old) => old.count += new.count,
        None => work.push(new),
    }
}

/// Returns the number of scalars of a type; arrays and structures count as one, because they are memory.
fn scalars(module: &Module, ty: TypeId) -> u32 {
    module.types.components(ty).unwrap_or(1)
}

/// Returns whether a place is at an index that is known only at run time.
fn is_indexed(f: &Function, place: Value) -> bool {
    match f[place] {
        Op::Element { .. } => true,
        Op::Part { base, .. } => is_indexed(f, base),
        _ => false,
    }
}

/// Passes the operations of one value by class and number of components.
fn cost(module: &Module, f: &Function, op: &Op, value: Value, add: &mut impl FnMut(OpClass, u32, Option<u8>)) {
    use OpClass as C;
    let size = |value: Value| scalars(module, f.ty(value));
    let is_float = |value: Value| module.types.scalar(f.ty(value)) == Some(Scalar::Float);
    let own = size(value);
    match *op {
        Op::Unary { op: Unary::LogicalNot, .. } => add(C::Select, own, None),
        Op::Unary { .. } => add(if is_float(value) { C::Add } else { C::Integer }, own, None),
        Op::Binary { op, left, right } => binary(module, f, (op, left, right), own, add),
        Op::Math { fun, arg, .. } => math(fun, (size(arg), own), is_float(arg), add),
        Op::Select { .. } => add(C::Select, own, None),
        Op::All(vector) | Op::Any(vector) => add(C::Select, size(vector).saturating_sub(1), None),
        Op::Convert { .. } => add(C::Convert, own, None),
        Op::Derivative { .. } => add(C::Derivative, own, None),
        Op::Sample { channel, .. } => {
            let dim = module.textures.get(usize::from(channel)).map(|texture| texture.dim);
            let class = match dim {
                Some(SamplerDim::D3) => C::SampleVolume,
                Some(SamplerDim::Cube) => C::SampleCube,
                _ => C::Sample,
            };
            add(class, 1, Some(channel));
        }
        Op::Gather { channel, .. } => add(C::Gather, 1, Some(channel)),
        Op::Fetch { channel, .. } => add(C::Fetch, 1, Some(channel)),
        Op::TextureSize { channel, .. } | Op::TextureLevels { channel } => add(C::TextureSize, 1, Some(channel)),
        Op::Load { place } => add(C::ArrayLoad, if is_indexed(f, place) { own } else { 0 }, None),
        Op::Element { .. } if !f.is_place(value) => add(C::ArrayLoad, 1, None),
        Op::Call { .. } => add(C::Call, 1, None),
        _ => add(C::Add, 0, None),
    }
}

/// Returns whether compilers know a value.
fn is_constant(f: &Function, value: Value) -> bool {
    match f[value] {
        Op::Literal(..) | Op::Const(_) | Op::Zero(_) => true,
        Op::Splat { value, .. } => is_constant(f, value),
        Op::Compose { ref parts, .. } => parts.iter().all(|part| is_constant(f, *part)),
        _ => false,
    }
}

fn binary(
    module: &Module,
    f: &Function,
    (op, left, right): (Binary, Value, Value),
    own: u32,
    add: &mut impl FnMut(OpClass, u32, Option<u8>),
) {
    use OpClass as C;
    let is_float = module.types.scalar(f.ty(left)) == Some(Scalar::Float);
    let ty = |value: Value| module.types.get(f.ty(value));
    match op {
        Binary::Multiply => match (ty(left), ty(right)) {
            // The length of the rows that are multiplied with columns.
            (Type::Matrix { columns, .. }, Type::Vector { .. } | Type::Matrix { .. }) => {
                add(C::Multiply, own * u32::from(columns), None);
                add(C::Add, own * (u32::from(columns) - 1), None);
            }
            (Type::Vector { size, .. }, Type::Matrix { .. }) => {
                add(C::Multiply, own * u32::from(size), None);
                add(C::Add, own * (u32::from(size) - 1), None);
            }
            _ => add(if is_float { C::Multiply } else { C::IntegerMultiply }, own, None),
        },
        Binary::Add | Binary::Subtract => add(if is_float { C::Add } else { C::Integer }, own, None),
        // Compilers multiply instead of dividing by a constant.
        Binary::Divide if is_constant(f, right) => {
            add(if is_float { C::Multiply } else { C::IntegerMultiply }, own, None);
            add(C::Integer, if is_float { 0 } else { own }, None);
        }
        Binary::Modulo if is_constant(f, right) && !is_float => {
            add(C::IntegerMultiply, 2 * own, None);
            add(C::Integer, 2 * own, None);
        }
        Binary::Divide if is_float => add(C::Divide, own, None),
        Binary::Modulo if is_float => {
            add(if is_constant(f, right) { C::Multiply } else { C::Divide }, own, None);
            add(C::Round, own, None);
            add(C::Add, own, None);
            add(C::Multiply, own, None);
        }
        Binary::Divide | Binary::Modulo => add(C::IntegerDivide, own, None),
        Binary::LogicalAnd => add(C::Select, own, None),
        _ if op.is_comparison() => add(C::Select, scalars(module, f.ty(left)), None),
        _ => add(C::Integer, own, None),
    }
}

/// Passes the operations of a function of arguments of `size` components; its result has `own`.
fn math(fun: Math, (size, own): (u32, u32), is_float: bool, add: &mut impl FnMut(OpClass, u32, Option<u8>)) {
    use Math::*;
    use OpClass as C;
    let mut all = |parts: &[(OpClass, u32)]| parts.iter().for_each(|&(class, count)| add(class, count, None));
    match fun {
        Abs | Sign | Min | Max => all(&[(if is_float { C::MinMax } else { C::Integer }, own)]),
        Clamp | Saturate => all(&[(if is_float { C::MinMax } else { C::Integer }, 2 * own)]),
        Floor | Ceil | Trunc | Round => all(&[(C::Round, own)]),
        Fract => all(&[(C::Round, own), (C::Add, own)]),
        Mix => all(&[(C::Multiply, own), (C::Add, 2 * own)]),
        SmoothStep => all(&[(C::Divide, own), (C::MinMax, 2 * own), (C::Multiply, 3 * own), (C::Add, 3 * own)]),
        Sqrt | InverseSqrt => all(&[(C::SquareRoot, own)]),
        Pow => all(&[(C::Power, own)]),
        Exp | Exp2 | Log | Log2 => all(&[(C::Exponential, own)]),
        Radians | Degrees => all(&[(C::Multiply, own)]),
        Sin | Cos => all(&[(C::Sine, own)]),
        Tan => all(&[(C::Tangent, own)]),
        Asin | Acos | Atan | Atan2 => all(&[(C::Arc, own)]),
        Sinh | Cosh | Tanh => all(&[(C::Exponential, 2 * own), (C::Add, 2 * own), (C::Multiply, own)]),
        Asinh | Acosh | Atanh => all(&[(C::Exponential, own), (C::SquareRoot, own), (C::Add, 2 * own)]),
        Cross => all(&[(C::Multiply, 6), (C::Add, 3)]),
        Length => all(&[(C::Multiply, size), (C::Add, size.saturating_sub(1)), (C::SquareRoot, 1)]),
        Normalize => all(&[(C::Multiply, 2 * size), (C::Add, size.saturating_sub(1)), (C::SquareRoot, 1)]),
        FaceForward => all(&[(C::Multiply, size), (C::Add, size), (C::Select, size)]),
        Determinant => all(&[(C::Multiply, 2 * size), (C::Add, size)]),
        Transpose => {}
        Pack2x16snorm | Pack2x16unorm | Pack4x8snorm | Pack4x8unorm => {
            all(&[(C::MinMax, 2 * size), (C::Multiply, size), (C::Convert, size), (C::Integer, 2 * size)]);
        }
        Unpack2x16snorm | Unpack2x16unorm | Unpack4x8snorm | Unpack4x8unorm => {
            all(&[(C::Integer, 2 * own), (C::Convert, own), (C::Multiply, own)]);
        }
        Pack2x16float => all(&[(C::Convert, 2), (C::Integer, 2)]),
        Unpack2x16float => all(&[(C::Convert, 2), (C::Integer, 2)]),
        CountOneBits | ReverseBits => all(&[(C::Integer, 12 * own)]),
        FirstTrailingBit | FirstLeadingBit => all(&[(C::Integer, 4 * own)]),
        ExtractBits | InsertBits => all(&[(C::Integer, 6 * own)]),
    }
}

/// The operations that are available at a place: value numbering over the dominator tree (Briggs, Cooper and Simpson,
/// "Value numbering", Software: Practice and Experience 27(6), 1997).
#[derive(Default)]
pub(super) struct Operations {
    /// The first value that the operation, on first values, computed.
    available: FxHashMap<String, Value>,
    /// The keys in `available`, in order.
    order: Vec<String>,
    /// The first value that is equal to a value.
    first: FxHashMap<Value, Value>,
    /// Counts events that may have changed any variable: calls, and control flow that joins.
    epoch: u32,
    /// The number of stores to each variable.
    versions: FxHashMap<Root, u32>,
}

/// The variable, parameter or global that contains a place.
#[derive(PartialEq, Eq, Hash)]
enum Root {
    Var(VarId),
    Global(GlobalId),
    Param(u32),
}

impl Root {
    fn of(f: &Function, place: Value) -> Option<Self> {
        match f[f.root(place)] {
            Op::Var(id) => Some(Self::Var(id)),
            Op::Global(id) => Some(Self::Global(id)),
            Op::Param(index) => Some(Self::Param(index)),
            _ => None,
        }
    }
}

impl Operations {
    /// Starts a function.
    pub(super) fn start(&mut self) {
        *self = Self::default();
    }

    /// Enters a nested block.
    pub(super) fn enter(&mut self) -> usize {
        self.epoch += 1;
        self.order.len()
    }

    pub(super) fn leave(&mut self, scope: usize) {
        self.epoch += 1;
        for key in self.order.drain(scope..) {
            self.available.remove(&key);
        }
    }

    fn insert(&mut self, key: String, value: Value) {
        if self.available.insert(key.clone(), value).is_none() {
            self.order.push(key);
        }
    }

    /// Returns whether the operation of a value has not been computed before.
    fn number(&mut self, module: &Module, f: &Function, value: Value) -> bool {
        let op = &f[value];
        if let Op::Call { .. } = op {
            self.epoch += 1;
            return true;
        }
        let key = match *op {
            Op::Load { place } => self.load_key(module, f, place),
            _ => self.key(f, op),
        };
        match self.available.get(&key) {
            Some(&same) => {
                self.first.insert(value, same);
                false
            }
            None => {
                self.insert(key, value);
                true
            }
        }
    }

    fn store(&mut self, f: &Function, place: Value, value: Value) {
        if let Some(root) = Root::of(f, place) {
            *self.versions.entry(root).or_default() += 1;
        }
        if let Op::Var(_) | Op::Global(_) = f[place] {
            let key = format!("load {} {}", self.version(f, place), self.key(f, &f[place]));
            let first = self.first.get(&value).copied().unwrap_or(value);
            self.insert(key, first);
        }
    }

    /// Returns what distinguishes the present contents of a variable from those before.
    fn version(&self, f: &Function, place: Value) -> String {
        let stores = Root::of(f, place).and_then(|root| self.versions.get(&root)).copied().unwrap_or(0);
        format!("{}.{stores}", self.epoch)
    }

    fn load_key(&self, module: &Module, f: &Function, place: Value) -> String {
        let is_constant = matches!(f[f.root(place)], Op::Global(id) if module[id].kind.is_read_only());
        let version = if is_constant { String::new() } else { self.version(f, place) };
        format!("load {version} {}", self.key(f, &f[place]))
    }

    /// Returns the operation on the first values that are equal to its operands; free operands are written out.
    fn key(&self, f: &Function, op: &Op) -> String {
        let mut op = op.clone();
        let mut free = String::new();
        op.operands_mut(|operand| {
            if f[*operand].is_free() {
                free.push_str(&format!(" {:?}", f[*operand]));
                *operand = Value::new(0);
            } else {
                free.push_str(" -");
                *operand = self.first.get(operand).copied().unwrap_or(*operand);
            }
        });
        format!("{op:?}{free}")
    }
}
