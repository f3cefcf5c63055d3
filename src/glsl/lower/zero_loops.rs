//! Zeros of long arrays, written by loops.
//!
//! naga's SPIR-V writer gives every variable an initialiser of zeros. Mesa makes one store a scalar of it, all in one block
//! (`nir_lower_variable_initializers`), and LLVM's time for a block of them grows with about their cube: a local
//! `float a[500]` takes half a minute to the first frame on lavapipe. A program with long arrays therefore writes these zeros
//! by loops, and says so, so that the initialisers can be left out ([`crate::glsl::Compiled::filled_arrays`]).
//!
//! lavapipe stores to an element that a loop counts lane by lane. So arrays of moderate length are filled by blocks of a few
//! known elements, each of them a loop of one round that no driver can see to be one.

use std::collections::HashSet;

use naga::{
    AddressSpace, ArraySize, BinaryOperator, Binding, Block, BuiltIn, EntryPoint, Expression, Function, GlobalVariable,
    Handle, Literal, LocalVariable, MemoryDecorations, Module, Range, Scalar, ScalarKind, Span, Statement, Type,
    TypeInner, UniqueArena,
};

use super::function::Value;

/// Scalars of all arrays without a value of a program, from which on loops write their zeros. 100 take lavapipe 0.4 s, 160
/// take 1.5 s, 256 take 6 s.
const FEWEST_SCALARS: u32 = 128;

/// Scalars from which on an array of such a program gets its zeros by a loop. A loop also costs a driver time.
const LEAST_ARRAY: u32 = 16;

/// Scalars that one block writes.
const BLOCK: u32 = 32;

/// Scalars up to which a program's arrays are filled by blocks. 500 take lavapipe 3 s, 800 take 7 s, and a second by loops;
/// frames are then as quick as with initialisers, and take up to twice as long with loops.
const MOST_IN_BLOCKS: u32 = 512;

/// Makes loops of all zeros that long arrays are filled with: of whole values that are stored, of locals where their function
/// begins, of private globals where the entry point does. `filled` are globals that are stored as a whole before all else,
/// in each call of the one function that knows them.
///
/// Returns the length in scalars from which on every array has its zeros, or another value, before anything reads it,
/// though its variable had no initialiser; `None` if the program has few and was left as it is.
pub(super) fn write(module: &mut Module, filled: &HashSet<Handle<GlobalVariable>>) -> Option<u32> {
    let sizes = Sizes::new(&module.types);
    drop_zero_initialisers(module);
    let globals: Vec<_> = module
        .global_variables
        .iter()
        .filter(|(_, v)| v.space == AddressSpace::Private && v.init.is_none() && sizes.longest(v.ty) >= LEAST_ARRAY)
        .map(|(handle, v)| (handle, v.ty))
        .collect();
    let functions = module.functions.iter().map(|(_, f)| f).chain(module.entry_points.iter().map(|e| &e.function));
    let locals = functions.flat_map(|f| f.local_variables.iter().filter(|(_, v)| v.init.is_none()).map(|(_, v)| v.ty));
    let long = globals.iter().map(|(_, ty)| *ty).chain(locals.filter(|ty| sizes.longest(*ty) >= LEAST_ARRAY));
    let scalars = long.fold(0u32, |sum, ty| sum.saturating_add(sizes.scalars(ty)));
    if scalars < FEWEST_SCALARS {
        return None;
    }
    let uint = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let in_blocks = scalars <= MOST_IN_BLOCKS && module.entry_points.iter().all(|e| never_negative(e).is_some());
    let opaque = in_blocks.then(|| {
        let (space, memory_decorations) = (AddressSpace::Private, MemoryDecorations::empty());
        let opaque = GlobalVariable { name: None, space, binding: None, ty: uint, init: None, memory_decorations };
        module.global_variables.append(opaque, Span::UNDEFINED)
    });
    let types = &module.types;
    for (_, function) in module.functions.iter_mut() {
        Writer { types, sizes: &sizes, uint, opaque, function }.rewrite(&[], Block::new());
    }
    let globals: Vec<_> = globals.iter().map(|(global, _)| *global).filter(|global| !filled.contains(global)).collect();
    let global_types: Vec<_> = globals.iter().map(|&global| (global, module.global_variables[global].ty)).collect();
    for entry in &mut module.entry_points {
        let source = never_negative(entry);
        let mut writer = Writer { types, sizes: &sizes, uint, opaque, function: &mut entry.function };
        let mut start = Block::new();
        if let (Some(source), Some(opaque)) = (source, opaque) {
            writer.set_opaque(opaque, source, &mut start);
        }
        writer.rewrite(&global_types, start);
    }
    Some(LEAST_ARRAY)
}

/// Initialisers that are zeros in one piece are none: they are what naga writes without them.
fn drop_zero_initialisers(module: &mut Module) {
    let Module { global_expressions, constants, global_variables, functions, entry_points, .. } = module;
    let is_zero = |mut init: Handle<Expression>| loop {
        match global_expressions[init] {
            Expression::ZeroValue(_) => return true,
            Expression::Constant(constant) => init = constants[constant].init,
            _ => return false,
        }
    };
    for (_, variable) in global_variables.iter_mut() {
        variable.init = variable.init.filter(|&init| !is_zero(init));
    }
    let functions = functions.iter_mut().map(|(_, f)| f).chain(entry_points.iter_mut().map(|e| &mut e.function));
    for function in functions {
        for (_, variable) in function.local_variables.iter_mut() {
            variable.init = variable.init.filter(|&init| match function.expressions[init] {
                Expression::ZeroValue(_) => false,
                Expression::Constant(constant) => !is_zero(constants[constant].init),
                _ => true,
            });
        }
    }
}

/// An argument whose first bit is never set, though no driver knows that: where a pixel lies, or the number of a vertex.
fn never_negative(entry: &EntryPoint) -> Option<(u32, BuiltIn)> {
    (0..).zip(&entry.function.arguments).find_map(|(index, argument)| match argument.binding {
        Some(Binding::BuiltIn(built_in @ (BuiltIn::Position { .. } | BuiltIn::VertexIndex))) => Some((index, built_in)),
        _ => None,
    })
}

/// How much memory types take, by [`Handle::index`].
struct Sizes {
    scalars: Vec<u32>,
    /// Scalars of the longest array within.
    longest: Vec<u32>,
}

impl Sizes {
    fn new(types: &UniqueArena<Type>) -> Self {
        let mut sizes = Self { scalars: Vec::new(), longest: Vec::new() };
        for (_, ty) in types.iter() {
            let (scalars, longest) = match &ty.inner {
                TypeInner::Vector { size, .. } => (*size as u32, 0),
                TypeInner::Matrix { columns, rows, .. } => (*columns as u32 * *rows as u32, 0),
                TypeInner::Array { base, size: ArraySize::Constant(len), .. } => {
                    let scalars = sizes.scalars(*base).saturating_mul(len.get());
                    (scalars, scalars)
                }
                TypeInner::Struct { members, .. } => {
                    let scalars = members.iter().fold(0u32, |sum, m| sum.saturating_add(sizes.scalars(m.ty)));
                    (scalars, members.iter().map(|m| sizes.longest(m.ty)).max().unwrap_or(0))
                }
                _ => (1, 0),
            };
            sizes.scalars.push(scalars);
            sizes.longest.push(longest);
        }
        sizes
    }

    fn scalars(&self, ty: Handle<Type>) -> u32 {
        self.scalars[ty.index()]
    }

    fn longest(&self, ty: Handle<Type>) -> u32 {
        self.longest[ty.index()]
    }
}

/// Writes loops into one function.
struct Writer<'a> {
    types: &'a UniqueArena<Type>,
    sizes: &'a Sizes,
    uint: Handle<Type>,
    /// Holds a zero that no driver knows.
    opaque: Option<Handle<GlobalVariable>>,
    function: &'a mut Function,
}

impl Writer<'_> {
    /// Stores the zero that no driver knows.
    fn set_opaque(&mut self, opaque: Handle<GlobalVariable>, source: (u32, BuiltIn), block: &mut Block) {
        let (index, built_in) = source;
        let mut value = self.expression(Expression::FunctionArgument(index));
        if let BuiltIn::Position { .. } = built_in {
            value = self.emit(Expression::AccessIndex { base: value, index: 0 }, block);
            value = self.emit(Expression::As { expr: value, kind: ScalarKind::Uint, convert: None }, block);
        }
        let right = self.expression(Expression::Literal(Literal::U32(31)));
        value = self.emit(Expression::Binary { op: BinaryOperator::ShiftRight, left: value, right }, block);
        let pointer = self.expression(Expression::GlobalVariable(opaque));
        block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
    }

    /// Fills these globals and all long locals at the start, behind `block`, and makes loops of the zeros that are stored.
    fn rewrite(mut self, globals: &[(Handle<GlobalVariable>, Handle<Type>)], mut block: Block) {
        let locals = self.function.local_variables.iter();
        let is_long = |v: &LocalVariable| v.init.is_none() && self.sizes.longest(v.ty) >= LEAST_ARRAY;
        let locals: Vec<_> = locals.filter(|(_, v)| is_long(v)).map(|(handle, v)| (handle, v.ty)).collect();
        let body = std::mem::take(&mut self.function.body);
        for &(global, ty) in globals {
            let pointer = self.expression(Expression::GlobalVariable(global));
            self.fill(pointer, ty, &mut block);
        }
        for (local, ty) in locals {
            let pointer = self.expression(Expression::LocalVariable(local));
            self.fill(pointer, ty, &mut block);
        }
        block.append(&mut self.block(body));
        self.function.body = block;
    }

    fn block(&mut self, block: Block) -> Block {
        let mut out = Block::with_capacity(block.len());
        for (mut statement, span) in block.span_into_iter() {
            if let Statement::Store { pointer, value } = statement
                && let Expression::ZeroValue(ty) = self.function.expressions[value]
                && self.sizes.longest(ty) >= LEAST_ARRAY
            {
                self.fill(pointer, ty, &mut out);
                continue;
            }
            match &mut statement {
                Statement::Block(block) => self.within(block),
                Statement::If { accept, reject, .. } => {
                    self.within(accept);
                    self.within(reject);
                }
                Statement::Switch { cases, .. } => cases.iter_mut().for_each(|case| self.within(&mut case.body)),
                Statement::Loop { body, continuing, .. } => {
                    self.within(body);
                    self.within(continuing);
                }
                _ => {}
            }
            out.push(statement, span);
        }
        out
    }

    fn within(&mut self, block: &mut Block) {
        let inner = std::mem::take(block);
        *block = self.block(inner);
    }

    /// Writes zeros to all of what `pointer` points to.
    fn fill(&mut self, pointer: Value, ty: Handle<Type>, block: &mut Block) {
        let types = self.types;
        match types[ty].inner {
            TypeInner::Array { base, size: ArraySize::Constant(len), .. } if self.sizes.scalars(ty) >= LEAST_ARRAY => {
                let blocks = self.opaque.filter(|_| self.sizes.scalars(base) <= BLOCK);
                match blocks {
                    Some(opaque) => self.fill_by_blocks(opaque, pointer, base, len.get(), block),
                    None => self.fill_array(pointer, base, len.get(), block),
                }
            }
            TypeInner::Struct { ref members, .. } if self.sizes.longest(ty) >= LEAST_ARRAY => {
                for (index, member) in members.iter().enumerate() {
                    let part = self.emit(Expression::AccessIndex { base: pointer, index: index as u32 }, block);
                    self.fill(part, member.ty, block);
                }
            }
            _ => {
                let value = self.expression(Expression::ZeroValue(ty));
                block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
            }
        }
    }

    /// `do { pointer[0] = 0; pointer[1] = 0; ... } while (opaque != 0);` for each few elements.
    fn fill_by_blocks(
        &mut self,
        opaque: Handle<GlobalVariable>,
        pointer: Value,
        element: Handle<Type>,
        len: u32,
        block: &mut Block,
    ) {
        let opaque = self.expression(Expression::GlobalVariable(opaque));
        let zero = self.expression(Expression::Literal(Literal::U32(0)));
        let step = (BLOCK / self.sizes.scalars(element).max(1)).max(1);
        for first in (0..len).step_by(step as usize) {
            let mut body = Block::new();
            for index in first..len.min(first + step) {
                let place = self.emit(Expression::AccessIndex { base: pointer, index }, &mut body);
                self.fill(place, element, &mut body);
            }
            let value = self.emit(Expression::Load { pointer: opaque }, &mut body);
            let is_zero = Expression::Binary { op: BinaryOperator::Equal, left: value, right: zero };
            let condition = self.emit(is_zero, &mut body);
            let leave = Block::from_vec(vec![Statement::Break]);
            body.push(Statement::If { condition, accept: leave, reject: Block::new() }, Span::UNDEFINED);
            block.push(Statement::Loop { body, continuing: Block::new(), break_if: None }, Span::UNDEFINED);
        }
    }

    /// `for (uint i = 0; i < len; i++) pointer[i] = 0;`
    fn fill_array(&mut self, pointer: Value, element: Handle<Type>, len: u32, block: &mut Block) {
        let counter = LocalVariable { name: None, ty: self.uint, init: None };
        let counter = self.function.local_variables.append(counter, Span::UNDEFINED);
        let counter = self.expression(Expression::LocalVariable(counter));
        let [zero, one, len] = [0, 1, len].map(|n| self.expression(Expression::Literal(Literal::U32(n))));
        block.push(Statement::Store { pointer: counter, value: zero }, Span::UNDEFINED);
        let mut body = Block::new();
        let index = self.emit(Expression::Load { pointer: counter }, &mut body);
        let binary = |op, right| Expression::Binary { op, left: index, right };
        let condition = self.emit(binary(BinaryOperator::Less, len), &mut body);
        let leave = Block::from_vec(vec![Statement::Break]);
        body.push(Statement::If { condition, accept: Block::new(), reject: leave }, Span::UNDEFINED);
        let place = self.emit(Expression::Access { base: pointer, index }, &mut body);
        self.fill(place, element, &mut body);
        let next = self.emit(binary(BinaryOperator::Add, one), &mut body);
        body.push(Statement::Store { pointer: counter, value: next }, Span::UNDEFINED);
        block.push(Statement::Loop { body, continuing: Block::new(), break_if: None }, Span::UNDEFINED);
    }

    fn expression(&mut self, expression: Expression) -> Value {
        self.function.expressions.append(expression, Span::UNDEFINED)
    }

    /// An expression that is computed here.
    fn emit(&mut self, expression: Expression, block: &mut Block) -> Value {
        let value = self.expression(expression);
        block.push(Statement::Emit(Range::new_from_bounds(value, value)), Span::UNDEFINED);
        value
    }
}
