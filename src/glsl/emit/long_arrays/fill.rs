//! Rewrites one function so that its long arrays are filled and copied by loops.

use rustc_hash::FxHashSet;

use naga::{
    ArraySize, BinaryOperator, Block, BuiltIn, Expression, GlobalVariable, Handle, Literal, LocalVariable, ScalarKind,
    Span, Statement, Type, TypeInner,
};

use super::{
    copy::Loads,
    writer::{MIN_ARRAY, Value, Writer},
};

/// The number of scalars that one block of zeros writes.
const BLOCK: u32 = 32;

impl Writer<'_> {
    /// Stores the zero that no driver knows: the first bit of this argument.
    pub(super) fn set_opaque(&mut self, (index, built_in): (u32, BuiltIn), block: &mut Block) {
        let Some(opaque) = self.opaque else { return };
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

    /// Fills these globals, and all long locals except those in `written_first`, at the start, after `block`, and
    /// replaces stores of long values with loops.
    pub(super) fn rewrite(
        mut self,
        globals: &[(Handle<GlobalVariable>, Handle<Type>)],
        written_first: &FxHashSet<Handle<LocalVariable>>,
        mut block: Block,
    ) {
        let locals = self.function.local_variables.iter();
        let is_long = |v: &LocalVariable| v.init.is_none() && self.sizes.longest(v.ty) >= MIN_ARRAY;
        let locals = locals.filter(|(handle, v)| is_long(v) && !written_first.contains(handle));
        let locals: Vec<_> = locals.map(|(handle, v)| (handle, v.ty)).collect();
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
        let mut loads = Loads::default();
        for (mut statement, span) in block.span_into_iter() {
            match &mut statement {
                Statement::Emit(range) => loads.record(range.clone(), self.function),
                Statement::Store { pointer, value } => {
                    let (pointer, value) = (*pointer, *value);
                    let stored = self.store_long(pointer, value, &loads, &mut out);
                    loads.invalidate(pointer, self.function);
                    if stored {
                        continue;
                    }
                }
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
            if !matches!(statement, Statement::Emit(_) | Statement::Store { .. }) {
                loads.invalidate_all();
            }
            out.push(statement, span);
        }
        out
    }

    fn within(&mut self, block: &mut Block) {
        let inner = std::mem::take(block);
        *block = self.block(inner);
    }

    /// Writes zeros to all of the memory that `pointer` points to.
    pub(super) fn fill(&mut self, pointer: Value, ty: Handle<Type>, block: &mut Block) {
        match self.types[ty].inner {
            TypeInner::Array { base, size: ArraySize::Constant(len), .. } if self.sizes.scalars(ty) >= MIN_ARRAY => {
                let opaque = self.opaque.filter(|_| self.in_blocks && self.sizes.scalars(base) <= BLOCK);
                match opaque {
                    Some(opaque) => self.fill_by_blocks(opaque, pointer, base, len.get(), block),
                    None => {
                        let len = self.uint(len.get());
                        self.count(len, block, |writer, index, body| {
                            let place = writer.emit(Expression::Access { base: pointer, index }, body);
                            writer.fill(place, base, body);
                        });
                    }
                }
            }
            TypeInner::Struct { ref members, .. } if self.sizes.longest(ty) >= MIN_ARRAY => {
                let members: Vec<_> = members.iter().map(|member| member.ty).collect();
                for (index, member) in (0..).zip(members) {
                    let part = self.emit(Expression::AccessIndex { base: pointer, index }, block);
                    self.fill(part, member, block);
                }
            }
            _ => {
                let value = self.expression(Expression::ZeroValue(ty));
                block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
            }
        }
    }

    /// Writes `do { pointer[0] = 0; pointer[1] = 0; ... } while (opaque != 0);` for each few elements.
    fn fill_by_blocks(
        &mut self,
        opaque: Handle<GlobalVariable>,
        pointer: Value,
        element: Handle<Type>,
        len: u32,
        block: &mut Block,
    ) {
        let opaque = self.expression(Expression::GlobalVariable(opaque));
        let zero = self.uint(0);
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
}
