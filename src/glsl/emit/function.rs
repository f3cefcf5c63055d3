//! One function: its statements and operations, each as naga's.

use std::collections::HashSet;

use naga::{
    BinaryOperator, Block, Expression, FunctionArgument, FunctionResult, Handle, ImageQuery, LocalVariable,
    MathFunction, Range, SampleLevel, ScalarKind, Span, Statement, SwitchCase, SwitchValue, SwizzleComponent,
    UnaryOperator,
};

use super::{
    consts,
    context::{Emitter, Map},
    types,
};
use crate::glsl::{
    ir::{self, Binary, Level, Math, Op, Stmt, Unary, Value},
    types::{Scalar, Swizzle, Type, TypeId},
};

/// A naga function under construction.
pub(super) struct Builder<'m, 'a> {
    pub cx: &'m mut Emitter<'a>,
    pub ir: &'m ir::Function,
    pub f: naga::Function,
    pub block: Block,
    /// First and last expression not yet emitted.
    unemitted: Option<(Handle<Expression>, Handle<Expression>)>,
    /// What each value became, by [`Value::index`].
    values: Vec<Option<Handle<Expression>>>,
    literals: Map<(u8, u32), Handle<Expression>>,
    /// Where the result goes of a function that returns a long one.
    pub long_result: Option<Handle<Expression>>,
    /// By [`ir::VarId`].
    vars: Vec<Handle<LocalVariable>>,
    /// Variables that are written before they are read, and so need no zeros.
    written_first: HashSet<Handle<LocalVariable>>,
}

/// Emits a function that is called.
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
            b.long_result = Some(b.given(Expression::FunctionArgument(index)));
        } else {
            let ty = b.cx.ty(function.result);
            b.f.result = Some(FunctionResult { ty, binding: None });
        }
    }
    b.block(&function.body);
    b.finish()
}

impl<'m, 'a> Builder<'m, 'a> {
    pub fn new(cx: &'m mut Emitter<'a>, function: &'m ir::Function) -> Self {
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
            written_first: HashSet::new(),
        };
        for (index, var) in function.vars.iter().enumerate() {
            if var.init.is_none() {
                builder.written_first.insert(builder.vars[index]);
            }
            // Zeros are what naga's variables begin with.
            if let Some(init) = var.init
                && !matches!(function[init], Op::Zero(_))
            {
                let init = builder.value(init);
                builder.f.local_variables[builder.vars[index]].init = Some(init);
            }
        }
        builder
    }

    pub fn finish(mut self) -> naga::Function {
        self.emit();
        self.f.body = self.block;
        self.cx.written_first.push(self.written_first);
        self.f
    }

    /// Ends the run of expressions at hand: what follows is no part of it.
    pub fn emit(&mut self) {
        if let Some((first, last)) = self.unemitted.take() {
            self.block.push(Statement::Emit(Range::new_from_bounds(first, last)), Span::UNDEFINED);
        }
    }

    pub fn push(&mut self, statement: Statement) {
        self.emit();
        self.block.push(statement, Span::UNDEFINED);
    }

    /// An expression that is computed here.
    pub fn add(&mut self, expression: Expression) -> Handle<Expression> {
        let value = self.f.expressions.append(expression, Span::UNDEFINED);
        let first = self.unemitted.map_or(value, |(first, _)| first);
        self.unemitted = Some((first, value));
        value
    }

    /// An expression that is there from the start of the function, or that a statement computes.
    pub fn given(&mut self, expression: Expression) -> Handle<Expression> {
        self.emit();
        self.f.expressions.append(expression, Span::UNDEFINED)
    }

    /// What a value or place became.
    pub fn value(&mut self, value: Value) -> Handle<Expression> {
        if let Some(made) = self.values[value.index()] {
            return made;
        }
        let made = match self.ir[value] {
            // Bit patterns are computed in the block at hand.
            Op::Literal(scalar, bits) if consts::literal(scalar, bits).is_none() => return self.literal(scalar, bits),
            Op::Literal(scalar, bits) => self.literal(scalar, bits),
            Op::Zero(ty) => {
                let ty = self.cx.ty(ty);
                self.given(Expression::ZeroValue(ty))
            }
            Op::Const(id) => match self.cx.constant(id) {
                Some(constant) => self.given(Expression::Constant(constant)),
                None => return self.composed(id),
            },
            Op::Param(index) => self.given(Expression::FunctionArgument(index)),
            Op::Var(id) => self.given(Expression::LocalVariable(self.vars[id.index()])),
            Op::Global(id) => match self.global(id) {
                Some(variable) => self.given(Expression::GlobalVariable(variable)),
                None => return self.block_member_of(id),
            },
            Op::Input(input) => {
                let index = self.argument_of(input);
                self.given(Expression::FunctionArgument(index))
            }
            ref op => unreachable!("{op:?} is used before it is computed"),
        };
        self.values[value.index()] = Some(made);
        made
    }

    /// A scalar constant, bit for bit.
    pub fn literal(&mut self, scalar: Scalar, bits: u32) -> Handle<Expression> {
        if let Some(&made) = self.literals.get(&(scalar as u8, bits)) {
            return made;
        }
        match consts::literal(scalar, bits) {
            Some(literal) => {
                let made = self.given(Expression::Literal(literal));
                self.literals.insert((scalar as u8, bits), made);
                made
            }
            None => {
                let bits = self.literal(Scalar::Uint, bits);
                self.add(Expression::As { expr: bits, kind: ScalarKind::Float, convert: None })
            }
        }
    }

    /// A constant that naga has none for.
    pub fn composed(&mut self, id: ir::ConstId) -> Handle<Expression> {
        let ir = self.cx.ir;
        let constant = &ir[id];
        if self.cx.is_long(constant.ty)
            && !self.cx.source.driver.tables_in_memory
            && !self.cx.holds_booleans(constant.ty)
        {
            // Copied from there by a loop.
            let index = self.cx.storage_index(id);
            let tables = self.cx.storage_tables();
            let base = self.given(Expression::GlobalVariable(tables));
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

    pub fn compose(&mut self, ty: TypeId, components: Vec<Handle<Expression>>) -> Handle<Expression> {
        let ty = self.cx.ty(ty);
        self.add(Expression::Compose { ty, components })
    }

    pub fn block(&mut self, block: &[Stmt]) {
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

    /// Computes a value where its statement stands.
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

    fn expression(&mut self, value: Value, op: &Op) -> Expression {
        if let Op::Compose { ty, ref parts } = *op {
            return self.compose_op(ty, parts);
        }
        let mut of = |value: Value| self.value(value);
        match *op {
            Op::Part { base, index } => Expression::AccessIndex { base: of(base), index },
            Op::Element { base, index } => Expression::Access { base: of(base), index: of(index) },
            Op::Swizzle { vector, swizzle } => Expression::Swizzle {
                size: types::vector_size(swizzle.len()),
                vector: of(vector),
                pattern: pattern(swizzle),
            },
            Op::Splat { size, value } => Expression::Splat { size: types::vector_size(size.into()), value: of(value) },
            Op::Unary { op, operand } => Expression::Unary { op: unary(op), expr: of(operand) },
            Op::Binary { op, left, right } => Expression::Binary { op: binary(op), left: of(left), right: of(right) },
            Op::Math { fun, arg, arg1, arg2, arg3 } => {
                let (arg, arg1, arg2, arg3) = (of(arg), arg1.map(&mut of), arg2.map(&mut of), arg3.map(&mut of));
                Expression::Math { fun: math(fun), arg, arg1, arg2, arg3 }
            }
            Op::Select { condition, accept, reject } => {
                Expression::Select { condition: of(condition), accept: of(accept), reject: of(reject) }
            }
            Op::Convert { value, to } => {
                let width = types::naga_scalar(to).width;
                Expression::As { expr: of(value), kind: types::naga_scalar(to).kind, convert: Some(width) }
            }
            Op::Bitcast { value, to } => {
                Expression::As { expr: of(value), kind: types::naga_scalar(to).kind, convert: None }
            }
            Op::All(argument) => Expression::Relational { fun: naga::RelationalFunction::All, argument: of(argument) },
            Op::Any(argument) => Expression::Relational { fun: naga::RelationalFunction::Any, argument: of(argument) },
            Op::Derivative { axis, value } => Expression::Derivative {
                axis: match axis {
                    ir::Axis::X => naga::DerivativeAxis::X,
                    ir::Axis::Y => naga::DerivativeAxis::Y,
                    ir::Axis::Width => naga::DerivativeAxis::Width,
                },
                ctrl: naga::DerivativeControl::None,
                expr: of(value),
            },
            Op::Sample { channel, coordinate, level, offset } => {
                let (coordinate, offset) = (of(coordinate), offset.map(&mut of));
                let level = match level {
                    Level::Auto => SampleLevel::Auto,
                    Level::Exact(level) => SampleLevel::Exact(of(level)),
                    Level::Bias(bias) => SampleLevel::Bias(of(bias)),
                    Level::Gradient { x, y } => SampleLevel::Gradient { x: of(x), y: of(y) },
                };
                let (image, sampler) = (self.cx.texture(channel), self.cx.sampler(channel));
                let (image, sampler) = (self.variable(image), self.variable(sampler));
                Expression::ImageSample {
                    image,
                    sampler,
                    gather: None,
                    coordinate,
                    array_index: None,
                    offset,
                    level,
                    depth_ref: None,
                    clamp_to_edge: false,
                }
            }
            Op::Fetch { channel, coordinate, level } => {
                let (coordinate, level) = (of(coordinate), of(level));
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                Expression::ImageLoad { image, coordinate, array_index: None, sample: None, level: Some(level) }
            }
            Op::TextureSize { channel, level } => {
                let level = level.map(&mut of);
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                let size = self.add(Expression::ImageQuery { image, query: ImageQuery::Size { level } });
                Expression::As { expr: size, kind: ScalarKind::Sint, convert: None }
            }
            Op::TextureLevels { channel } => {
                let image = self.cx.texture(channel);
                let image = self.variable(image);
                Expression::ImageQuery { image, query: ImageQuery::NumLevels }
            }
            ref other => unreachable!("{value:?} = {other:?} is no expression"),
        }
    }

    fn compose_op(&mut self, ty: TypeId, parts: &[Value]) -> Expression {
        let mut components = Vec::with_capacity(parts.len());
        let is_vector = matches!(self.cx.ir.types.get(ty), Type::Vector { .. });
        for &part in parts {
            match self.ir[part] {
                // naga's SPIR-V writer takes a constant vector within a constant vector for one component.
                Op::Const(id) if is_vector => {
                    let ir = self.cx.ir;
                    let scalar = ir.scalar(ir[id].ty);
                    components.extend(ir[id].words.iter().map(|&bits| self.literal(scalar, bits)));
                }
                Op::Zero(zero) if is_vector => {
                    let scalar = self.cx.ir.scalar(zero);
                    let size = self.cx.ir.extent(zero).max(1);
                    components.extend((0..size).map(|_| self.literal(scalar, 0)));
                }
                _ => components.push(self.value(part)),
            }
        }
        Expression::Compose { ty: self.cx.ty(ty), components }
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
            let pointer = self.given(Expression::LocalVariable(place));
            arguments.push(pointer);
            self.push(Statement::Call { function, arguments, result: None });
            return Some(self.add(Expression::Load { pointer }));
        }
        let result = (result != TypeId::VOID).then(|| self.given(Expression::CallResult(function)));
        self.push(Statement::Call { function, arguments, result });
        result
    }
}

fn pattern(swizzle: Swizzle) -> [SwizzleComponent; 4] {
    const XYZW: [SwizzleComponent; 4] =
        [SwizzleComponent::X, SwizzleComponent::Y, SwizzleComponent::Z, SwizzleComponent::W];
    let mut pattern = [SwizzleComponent::X; 4];
    for (i, component) in swizzle.iter().enumerate() {
        pattern[i] = XYZW[component];
    }
    pattern
}

fn unary(op: Unary) -> UnaryOperator {
    match op {
        Unary::Negate => UnaryOperator::Negate,
        Unary::LogicalNot => UnaryOperator::LogicalNot,
        Unary::BitwiseNot => UnaryOperator::BitwiseNot,
    }
}

fn binary(op: Binary) -> BinaryOperator {
    use BinaryOperator as To;
    match op {
        Binary::Add => To::Add,
        Binary::Subtract => To::Subtract,
        Binary::Multiply => To::Multiply,
        Binary::Divide => To::Divide,
        Binary::Modulo => To::Modulo,
        Binary::Equal => To::Equal,
        Binary::NotEqual => To::NotEqual,
        Binary::Less => To::Less,
        Binary::LessEqual => To::LessEqual,
        Binary::Greater => To::Greater,
        Binary::GreaterEqual => To::GreaterEqual,
        Binary::And => To::And,
        Binary::ExclusiveOr => To::ExclusiveOr,
        Binary::InclusiveOr => To::InclusiveOr,
        Binary::LogicalAnd => To::LogicalAnd,
        Binary::LogicalOr => To::LogicalOr,
        Binary::ShiftLeft => To::ShiftLeft,
        Binary::ShiftRight => To::ShiftRight,
    }
}

fn math(fun: Math) -> MathFunction {
    use MathFunction as To;
    match fun {
        Math::Abs => To::Abs,
        Math::Sign => To::Sign,
        Math::Floor => To::Floor,
        Math::Ceil => To::Ceil,
        Math::Trunc => To::Trunc,
        Math::Round => To::Round,
        Math::Fract => To::Fract,
        Math::Min => To::Min,
        Math::Max => To::Max,
        Math::Clamp => To::Clamp,
        Math::Saturate => To::Saturate,
        Math::Mix => To::Mix,
        Math::SmoothStep => To::SmoothStep,
        Math::Sqrt => To::Sqrt,
        Math::InverseSqrt => To::InverseSqrt,
        Math::Pow => To::Pow,
        Math::Exp => To::Exp,
        Math::Exp2 => To::Exp2,
        Math::Log => To::Log,
        Math::Log2 => To::Log2,
        Math::Radians => To::Radians,
        Math::Degrees => To::Degrees,
        Math::Sin => To::Sin,
        Math::Cos => To::Cos,
        Math::Tan => To::Tan,
        Math::Asin => To::Asin,
        Math::Acos => To::Acos,
        Math::Atan => To::Atan,
        Math::Atan2 => To::Atan2,
        Math::Sinh => To::Sinh,
        Math::Cosh => To::Cosh,
        Math::Tanh => To::Tanh,
        Math::Asinh => To::Asinh,
        Math::Acosh => To::Acosh,
        Math::Atanh => To::Atanh,
        Math::Cross => To::Cross,
        Math::Length => To::Length,
        Math::Normalize => To::Normalize,
        Math::FaceForward => To::FaceForward,
        Math::Determinant => To::Determinant,
        Math::Transpose => To::Transpose,
        Math::Pack2x16snorm => To::Pack2x16snorm,
        Math::Pack2x16unorm => To::Pack2x16unorm,
        Math::Pack2x16float => To::Pack2x16float,
        Math::Unpack2x16snorm => To::Unpack2x16snorm,
        Math::Unpack2x16unorm => To::Unpack2x16unorm,
        Math::Unpack2x16float => To::Unpack2x16float,
    }
}
