//! Adds statements and expressions to a function: the building blocks of the loops over long arrays.

use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, LocalVariable, Range,
    Span, Statement, Type, UniqueArena,
};

use super::sizes::Sizes;

/// An expression of a function.
pub(super) type Value = Handle<Expression>;

/// The number of scalars from which on an array of a program with long arrays is zeroed by a loop. A loop also costs a
/// driver time.
pub(super) const MIN_ARRAY: u32 = 16;

/// Writes loops into one function.
pub(super) struct Writer<'a> {
    pub types: &'a UniqueArena<Type>,
    pub sizes: &'a Sizes,
    /// The types and address spaces of the module's variables, by [`Handle::index`].
    pub globals: &'a [(Handle<Type>, AddressSpace)],
    pub uint: Handle<Type>,
    /// A zero that no driver knows.
    pub opaque: Option<Handle<GlobalVariable>>,
    /// Zeros are written by blocks of a few known elements.
    pub in_blocks: bool,
    pub function: &'a mut Function,
}

impl Writer<'_> {
    /// Adds `for (uint i = 0; i < len; i++) { iteration(i) }`.
    pub(super) fn count(
        &mut self,
        len: Value,
        block: &mut Block,
        iteration: impl FnOnce(&mut Self, Value, &mut Block),
    ) {
        let counter = LocalVariable { name: None, ty: self.uint, init: None };
        let counter = self.function.local_variables.append(counter, Span::UNDEFINED);
        let counter = self.expression(Expression::LocalVariable(counter));
        let [zero, one] = [0, 1].map(|n| self.uint(n));
        block.push(Statement::Store { pointer: counter, value: zero }, Span::UNDEFINED);
        let mut body = Block::new();
        let index = self.emit(Expression::Load { pointer: counter }, &mut body);
        let binary = |op, right| Expression::Binary { op, left: index, right };
        let condition = self.emit(binary(BinaryOperator::Less, len), &mut body);
        let leave = Block::from_vec(vec![Statement::Break]);
        body.push(Statement::If { condition, accept: Block::new(), reject: leave }, Span::UNDEFINED);
        iteration(self, index, &mut body);
        let next = self.emit(binary(BinaryOperator::Add, one), &mut body);
        body.push(Statement::Store { pointer: counter, value: next }, Span::UNDEFINED);
        block.push(Statement::Loop { body, continuing: Block::new(), break_if: None }, Span::UNDEFINED);
    }

    pub(super) fn uint(&mut self, number: u32) -> Value {
        self.expression(Expression::Literal(Literal::U32(number)))
    }

    pub(super) fn expression(&mut self, expression: Expression) -> Value {
        self.function.expressions.append(expression, Span::UNDEFINED)
    }

    /// Adds an expression that is computed here.
    pub(super) fn emit(&mut self, expression: Expression, block: &mut Block) -> Value {
        let value = self.expression(expression);
        block.push(Statement::Emit(Range::new_from_bounds(value, value)), Span::UNDEFINED);
        value
    }
}
