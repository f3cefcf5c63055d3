//! Emits a function: its variables, its statements, and the values they compute.

use rustc_hash::FxHashSet;

use naga::{
    Block, Expression, FunctionArgument, FunctionResult, Handle, LocalVariable, Range, ScalarKind, Span, Statement,
    SwitchCase, SwitchValue,
};

use super::{
    consts,
    context::{Emitter, Map},
};
use crate::{
    ir::{self, Binary, Op, Stmt, Value},
    types::{Scalar, Type, TypeId},
};

/// A naga function under construction.
pub(super) struct Builder<'m, 'a> {
    pub cx: &'m mut Emitter<'a>,
    pub ir: &'m ir::Function,
    pub f: naga::Function,
    pub block: Block,
    /// The first and last expression not yet emitted.
    unemitted: Option<(Handle<Expression>, Handle<Expression>)>,
    /// The expression of each value, by [`Value::index`].
    values: Vec<Option<Handle<Expression>>>,
    literals: Map<(u8, u32), Handle<Expression>>,
    /// The pointer for the result of a function with a long result.
    pub long_result: Option<Handle<Expression>>,
    /// By [`ir::VarId`].
    vars: Vec<Handle<LocalVariable>>,
    /// Variables that are written before they are read, and therefore need no zeros.
    written_first: FxHashSet<Handle<LocalVariable>>,
}

/// Emits a function that is not the entry point.
pub(super) fn emit(cx: &mut Emitter<'_>, function: &ir::Function) -> naga::Function {
    let mut b = Builder::new(cx, function);
    for param in &function.params {
        let ty = if param.by_reference { b.cx.pointer_ty(param.ty) } else { b.cx.ty(param.ty) };
        b.f.arguments.push(FunctionArgument { name: None, ty, binding: None });
    }
    if function.result != TypeId::VOID {
        if b.cx.is_long(function.result) {
            let index = b.f.arguments.len() as u32;
            let ty = b.cx.pointer_ty(function.result);
            b.f.arguments.push(FunctionArgument { name: None, ty, binding: None });
            b.long_result = Some(b.add_preemitted(Expression::FunctionArgument(index)));
        } else {
            let ty = b.cx.ty(function.result);
            b.f.result = Some(FunctionResult { ty, binding: None });
        }
    }
    b.block(&function.body);
    b.finish()
}

impl<'m, 'a> Builder<'m, 'a> {
    pub(super) fn new(cx: &'m mut Emitter<'a>, function: &'m ir::Function) -> Self {
        let mut f = naga::Function::default();
        let vars = function.vars.iter().map(|var| {
            let ty = cx.ty(var.ty);
            f.local_variables.append(LocalVariable { name: None, ty, init: None }, Span::UNDEFINED)
        });
        let vars = vars.collect();
        let mut builder = Self {
            cx,
            ir: function,
            f,
            block: Block::new(),
            unemitted: None,
            values: vec![None; function.len()],
            literals: Map::default(),
            long_result: None,
            vars,
            written_first: FxHashSet::default(),
        };
        for (index, var) in function.vars.iter().enumerate() {
            if var.init.is_none() {
                builder.written_first.insert(builder.vars[index]);
            }
            // naga's variables are initialised to zero by default.
            if let Some(init) = var.init
                && !matches!(function[init], Op::Zero(_))
            {
                let init = builder.value(init);
                builder.f.local_variables[builder.vars[index]].init = Some(init);
            }
        }
        builder
    }

    pub(super) fn finish(mut self) -> naga::Function {
        self.emit();
        self.f.body = self.block;
        self.cx.written_first.push(self.written_first);
        self.f
    }

    /// Ends the current run of expressions, so that later ones are not part of it.
    pub(super) fn emit(&mut self) {
        if let Some((first, last)) = self.unemitted.take() {
            self.block.push(Statement::Emit(Range::new_from_bounds(first, last)), Span::UNDEFINED);
        }
    }

    pub(super) fn push(&mut self, statement: Statement) {
        self.emit();
        self.block.push(statement, Span::UNDEFINED);
    }

    /// Adds an expression that is computed here.
    pub(super) fn add(&mut self, expression: Expression) -> Handle<Expression> {
        let value = self.f.expressions.append(expression, Span::UNDEFINED);
        let first = self.unemitted.map_or(value, |(first, _)| first);
        self.unemitted = Some((first, value));
        value
    }

    /// Adds an expression that no `Emit` may cover: it is available from the start of the function, or a statement
    /// computes it.
    pub(super) fn add_preemitted(&mut self, expression: Expression) -> Handle<Expression> {
        self.emit();
        self.f.expressions.append(expression, Span::UNDEFINED)
    }

    /// Returns the expression of a value or place.
    pub(super) fn value(&mut self, value: Value) -> Handle<Expression> {
        if let Some(made) = self.values[value.index()] {
            return made;
        }
        let made = match self.ir[value] {
            // Bit patterns are computed in the current block.
            Op::Literal(scalar, bits) if consts::literal(scalar, bits).is_none() => return self.literal(scalar, bits),
            Op::Literal(scalar, bits) => self.literal(scalar, bits),
            Op::Zero(ty) => {
                let ty = self.cx.ty(ty);
                self.add_preemitted(Expression::ZeroValue(ty))
            }
            Op::Const(id) => match self.cx.constant(id) {
                Some(constant) => self.add_preemitted(Expression::Constant(constant)),
                None => return self.composed(id),
            },
            Op::Param(index) => self.add_preemitted(Expression::FunctionArgument(index)),
            Op::Var(id) => self.add_preemitted(Expression::LocalVariable(self.vars[id.index()])),
            Op::Global(id) => match self.global(id) {
                Some(variable) => self.add_preemitted(Expression::GlobalVariable(variable)),
                None => return self.block_member_of(id),
            },
            Op::Input(input) => {
                let index = self.argument_of(input);
                self.add_preemitted(Expression::FunctionArgument(index))
            }
            ref op => unreachable!("{op:?} is used before it is computed"),
        };
        self.values[value.index()] = Some(made);
        made
    }

    /// Returns a scalar constant, bit for bit.
    pub(super) fn literal(&mut self, scalar: Scalar, bits: u32) -> Handle<Expression> {
        if let Some(&made) = self.literals.get(&(scalar as u8, bits)) {
            return made;
        }
        match consts::literal(scalar, bits) {
            Some(literal) => {
                let made = self.add_preemitted(Expression::Literal(literal));
                self.literals.insert((scalar as u8, bits), made);
                made
            }
            None => {
                let bits = self.literal(Scalar::Uint, bits);
                self.add(Expression::As { expr: bits, kind: ScalarKind::Float, convert: None })
            }
        }
    }

    /// Composes a constant that naga cannot represent.
    pub(super) fn composed(&mut self, id: ir::ConstId) -> Handle<Expression> {
        let ir = self.cx.ir;
        let constant = &ir[id];
        if self.cx.is_long(constant.ty)
            && !self.cx.source.driver.tables_in_memory
            && !self.cx.source.kind.is_plain()
            && !self.cx.contains_booleans(constant.ty)
        {
            // Copied from the storage buffer by a loop.
            let index = self.cx.storage_index(id);
            let tables = self.cx.storage_tables();
            let base = self.add_preemitted(Expression::GlobalVariable(tables));
            let pointer = self.add(Expression::AccessIndex { base, index });
            return self.add(Expression::Load { pointer });
        }
        self.value_of_words(constant.ty, &mut constant.words.iter().copied())
    }

    fn value_of_words(&mut self, ty: TypeId, words: &mut dyn Iterator<Item = u32>) -> Handle<Expression> {
        let ir = self.cx.ir;
        if let Type::Scalar(scalar) = ir.types.get(ty) {
            return self.literal(scalar, words.next().expect("as many words as scalars"));
        }
        let components = (0..ir.extent(ty)).map(|index| self.value_of_words(ir.part(ty, index), words)).collect();
        self.compose(ty, components)
    }

    pub(super) fn compose(&mut self, ty: TypeId, components: Vec<Handle<Expression>>) -> Handle<Expression> {
        let ty = self.cx.ty(ty);
        self.add(Expression::Compose { ty, components })
    }

    pub(super) fn block(&mut self, block: &[Stmt]) {
        for stmt in block {
            self.statement(stmt);
        }
    }

    fn nested(&mut self, block: &[Stmt]) -> Block {
        self.emit();
        let outer = std::mem::take(&mut self.block);
        self.block(block);
        self.emit();
        std::mem::replace(&mut self.block, outer)
    }

    fn statement(&mut self, stmt: &Stmt) {
        match stmt {
            Stmt::Let(value) => self.compute(*value),
            Stmt::Store { place, value } => {
                let value = self.value(*value);
                let pointer = self.value(*place);
                self.push(Statement::Store { pointer, value });
            }
            Stmt::If { condition, accept, reject } => {
                let condition = self.value(*condition);
                let (accept, reject) = (self.nested(accept), self.nested(reject));
                self.push(Statement::If { condition, accept, reject });
            }
            Stmt::Loop { body, continuing, break_if } => {
                let body = self.nested(body);
                self.emit();
                let outer = std::mem::take(&mut self.block);
                self.block(continuing);
                let break_if = break_if.map(|value| self.value(value));
                self.emit();
                let continuing = std::mem::replace(&mut self.block, outer);
                self.push(Statement::Loop { body, continuing, break_if });
            }
            Stmt::Switch { selector, cases } => {
                let unsigned = self.ir.ty(*selector) == TypeId::UINT;
                let selector = self.value(*selector);
                let cases = cases.iter().map(|case| {
                    let value = match case.label {
                        None => SwitchValue::Default,
                        Some(bits) if unsigned => SwitchValue::U32(bits),
                        Some(bits) => SwitchValue::I32(bits as i32),
                    };
                    SwitchCase { value, body: self.nested(&case.body), fall_through: case.falls_through }
                });
                let cases = cases.collect();
                self.push(Statement::Switch { selector, cases });
            }
            Stmt::Break => self.push(Statement::Break),
            Stmt::Continue => self.push(Statement::Continue),
            Stmt::Return(value) => {
                let value = value.map(|value| self.value(value));
                match (self.long_result, value) {
                    (Some(pointer), Some(value)) => {
                        self.push(Statement::Store { pointer, value });
                        self.push(Statement::Return { value: None });
                    }
                    _ => self.push(Statement::Return { value }),
                }
            }
            Stmt::Discard => self.push(Statement::Kill),
            Stmt::Output(parts) => self.output(parts),
        }
    }

    /// Computes a value at its statement.
    fn compute(&mut self, value: Value) {
        let ir = self.ir;
        let expression = match ir[value] {
            Op::Part { .. } | Op::Element { .. } if ir.is_place(value) => {
                let Some(pointer) = self.part_of_place(value) else { return };
                self.values[value.index()] = Some(pointer);
                return;
            }
            Op::Load { place } => {
                let made = self.load(place);
                self.values[value.index()] = Some(made);
                return;
            }
            Op::Call { function, ref args } => {
                let made = self.call(function, args);
                self.values[value.index()] = made;
                return;
            }
            Op::Binary { op: Binary::Modulo, left, right } => {
                let made = self.modulo(value, left, right);
                self.values[value.index()] = Some(made);
                return;
            }
            Op::OpaqueZero => {
                let made = self.opaque_zero();
                self.values[value.index()] = Some(made);
                return;
            }
            ref op => self.expression(value, op),
        };
        self.values[value.index()] = Some(self.add(expression));
    }

    fn call(&mut self, callee: ir::FuncId, args: &[Value]) -> Option<Handle<Expression>> {
        let mut arguments: Vec<_> = args.iter().map(|&arg| self.value(arg)).collect();
        let function = self.cx.functions[callee.index()];
        let result = self.cx.ir[callee].result;
        if result != TypeId::VOID && self.cx.is_long(result) {
            let ty = self.cx.ty(result);
            let place = LocalVariable { name: None, ty, init: None };
            let place = self.f.local_variables.append(place, Span::UNDEFINED);
            self.written_first.insert(place);
            let pointer = self.add_preemitted(Expression::LocalVariable(place));
            arguments.push(pointer);
            self.push(Statement::Call { function, arguments, result: None });
            return Some(self.add(Expression::Load { pointer }));
        }
        let result = (result != TypeId::VOID).then(|| self.add_preemitted(Expression::CallResult(function)));
        self.push(Statement::Call { function, arguments, result });
        result
    }
}
