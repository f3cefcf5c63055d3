//! Built-in functions of chapter 8, except texture functions.

use super::{
    function::{Builder, PartOf},
    names::Precondition,
    operators::Typed,
};
use crate::{
    builtins::Operation,
    hir::{Builtin, ExprId, Scalar, TypeId},
    ir::{Axis, Binary, Block, Detail, Math, Op, Stmt, Value},
};

impl Builder<'_, '_> {
    pub(super) fn math(&mut self, fun: Math, arg: Value) -> Value {
        self.add(Op::Math { fun, arg, arg1: None, arg2: None, arg3: None })
    }

    pub(super) fn math2(&mut self, fun: Math, arg: Value, arg1: Value) -> Value {
        self.add(Op::Math { fun, arg, arg1: Some(arg1), arg2: None, arg3: None })
    }

    pub(super) fn math3(&mut self, fun: Math, arg: Value, arg1: Value, arg2: Value) -> Value {
        self.add(Op::Math { fun, arg, arg1: Some(arg1), arg2: Some(arg2), arg3: None })
    }

    /// Calls a built-in of result type `ty`; returns `None` for void ones.
    pub(super) fn builtin(&mut self, builtin: Builtin, ty: TypeId, args: &[ExprId]) -> Option<Value> {
        match builtin.operation {
            Operation::Modf => return Some(self.modf(args)),
            Operation::Frexp => return Some(self.frexp(ty, args)),
            Operation::AddCarry => return Some(self.add_carry(ty, args)),
            Operation::SubtractBorrow => return Some(self.subtract_borrow(ty, args)),
            Operation::MultiplyExtended => {
                self.multiply_extended(args);
                return None;
            }
            Operation::Assert => {
                self.st_assert(args);
                return None;
            }
            operation if builtin.is_texture() => return Some(self.texture(operation, ty, args)),
            _ => {}
        }
        let types = args.iter().map(|&arg| self.cx.hir[arg].ty);
        let values: Vec<Typed> = types.zip(self.values(args)).collect();
        let values = &values[..];
        self.builtin = Some(builtin);
        let value = self.operation(builtin.operation, ty, values);
        self.builtin = None;
        if !builtin.undefined_for.is_empty() {
            self.record_precondition(value, || Precondition::Call(builtin, values.iter().map(|arg| arg.1).collect()));
        }
        Some(value)
    }

    /// Lowers an operation; `ty` is the result type.
    fn operation(&mut self, operation: Operation, ty: TypeId, args: &[Typed]) -> Value {
        use Operation as O;
        match (operation, args) {
            (O::Function(fun), _) => self.function(fun, ty, args),
            (O::Compare(Binary::NotEqual), &[(_, a), (_, b)]) => {
                // Not `!=`: naga's is false for NaN.
                let equal = self.op(Binary::Equal, a, b);
                self.not(equal)
            }
            (O::Compare(op), &[(_, a), (_, b)]) => self.op(op, a, b),
            (O::Bitcast(to), &[(_, a)]) => self.bitcast(a, to),
            (O::Derivative(axis, detail), &[(_, a)]) => self.derivative(axis, detail, a),
            (O::Any, &[(_, a)]) => self.add(Op::Any(a)),
            (O::All, &[(_, a)]) => self.add(Op::All(a)),
            (O::Not, &[(_, a)]) => self.not(a),
            (O::Exponent(op), &[(ty, a)]) => self.exponent_test(op, ty, a),
            (O::Atan, &[(_, x)]) => self.math(Math::Atan, x),
            (O::Atan, &[(_, y), (_, x)]) => self.math2(Math::Atan2, y, x),
            (O::Modulo, &[(_, a), b]) => {
                // x - y * floor(x / y): naga's remainder truncates. If y is a constant zero, drivers drop the product,
                // and x remains: shaders use this to repeat space along some axes only, so that divisor must stay
                // visible to the driver.
                let b = self.splat_to(b.1, b.0, ty);
                let quotient = self.op(Binary::Divide, a, b);
                let whole = self.math(Math::Floor, quotient);
                let multiple = self.op(Binary::Multiply, b, whole);
                self.op(Binary::Subtract, a, multiple)
            }
            (O::Fma, &[(_, a), (_, b), (_, c)]) => {
                let product = self.op(Binary::Multiply, a, b);
                self.op(Binary::Add, product, c)
            }
            (O::Interpolate, &[(_, x)] | &[(_, x), (TypeId::INT, _)]) => x,
            (O::Interpolate, &[(_, x), (_, offset)]) => {
                // Exact for what is interpolated linearly on the screen.
                [Axis::X, Axis::Y].into_iter().zip(0..).fold(x, |moved, (axis, index)| {
                    let slope = self.derivative(axis, Detail::Any, x);
                    let distance = self.add(Op::Part { base: offset, index });
                    let distance = self.splat_to(distance, TypeId::FLOAT, ty);
                    let change = self.op(Binary::Multiply, slope, distance);
                    self.op(Binary::Add, moved, change)
                })
            }
            (O::Ldexp, &[(_, x), (exponent_ty, exponent)]) => self.ldexp(x, exponent_ty, exponent),
            (O::BitPosition(fun), &[(arg_ty, a)]) => {
                let position = self.math(fun, a);
                if arg_ty == ty { position } else { self.bitcast(position, Scalar::Int) }
            }
            (O::BitfieldExtract, &[(_, value), (_, offset), (_, count)]) => {
                let [offset, count] = [offset, count].map(|number| self.bitcast(number, Scalar::Uint));
                self.math3(Math::ExtractBits, value, offset, count)
            }
            (O::BitfieldInsert, &[(_, base), (_, insert), (_, offset), (_, count)]) => {
                let [offset, count] = [offset, count].map(|number| self.bitcast(number, Scalar::Uint));
                let (arg1, arg2, arg3) = (Some(insert), Some(offset), Some(count));
                self.add(Op::Math { fun: Math::InsertBits, arg: base, arg1, arg2, arg3 })
            }
            (O::Mix, &[(_, a), (_, b), (c_ty, c)]) => match self.cx.hir.types.scalar(c_ty) {
                Some(Scalar::Bool) => self.select(c, b, a),
                _ => {
                    let c = self.splat_to(c, c_ty, ty);
                    self.math3(Math::Mix, a, b, c)
                }
            },
            (O::Step, &[(a_ty, a), (_, b)]) => {
                // Zero for NaN on either side, as in OpenGL drivers; SPIR-V's `Step` may return one.
                let a = self.splat_to(a, a_ty, ty);
                let reached = self.op(Binary::GreaterEqual, b, a);
                self.add(Op::Convert { value: reached, to: Scalar::Float })
            }
            (O::Smoothstep, &[a, b, (_, x)]) => {
                let [a, b] = [a, b].map(|(edge_ty, edge)| self.splat_to(edge, edge_ty, ty));
                self.smoothstep(ty, a, b, x)
            }
            (O::Length, &[(ty, a)]) => self.length(ty, a),
            (O::Distance, &[(ty, a), (_, b)]) => {
                let difference = self.op(Binary::Subtract, a, b);
                self.length(ty, difference)
            }
            (O::Dot, &[(ty, a), (_, b)]) => self.dot(ty, a, b),
            // A unit "vector" of one component is its sign.
            (O::Normalize, &[(TypeId::FLOAT, a)]) => self.math(Math::Sign, a),
            (O::Normalize, &[(ty, a)]) => self.normalize(ty, a),
            (O::FaceForward, &[(TypeId::FLOAT, n), (_, i), (_, reference)]) => {
                let product = self.op(Binary::Multiply, reference, i);
                let zero = self.float(0.0);
                let faces = self.op(Binary::Less, product, zero);
                let minus = self.float(-1.0);
                let turned = self.op(Binary::Multiply, n, minus);
                self.select(faces, n, turned)
            }
            (O::FaceForward, &[(_, n), (_, i), (_, reference)]) => self.math3(Math::FaceForward, n, i, reference),
            (O::Reflect, &[(_, i), (_, n)]) => self.reflect(ty, i, n),
            (O::Refract, &[(_, i), (_, n), (_, eta)]) => self.refract(ty, i, n, eta),
            (O::MatrixCompMult, &[(ty, a), (_, b)]) => self.matrix_comp_mult(ty, a, b),
            (O::OuterProduct, &[(_, a), (b_ty, b)]) => self.outer_product(ty, b_ty, a, b),
            (O::Determinant, &[(ty, a)]) => self.determinant(ty, a),
            (O::Inverse, &[(ty, a)]) => self.inverse(ty, a),
            (other, _) => unreachable!("{other:?} does not take {} arguments", args.len()),
        }
    }

    /// Adds a function of the intermediate representation.
    fn function(&mut self, fun: Math, ty: TypeId, args: &[Typed]) -> Value {
        let mut values = [None; 3];
        for (value, &(arg_ty, arg)) in values.iter_mut().zip(args) {
            *value = Some(if fun.is_componentwise() { self.splat_to(arg, arg_ty, ty) } else { arg });
        }
        let [arg, arg1, arg2] = values;
        let arg = arg.expect("every built-in has an argument");
        self.add(Op::Math { fun, arg, arg1, arg2, arg3: None })
    }

    /// Adds `isnan` or `isinf` by the bits: a driver that assumes all floats to be finite removes the tests themselves.
    fn exponent_test(&mut self, op: Binary, ty: TypeId, value: Value) -> Value {
        let ty = TypeId::vector(Scalar::Uint, self.extent(ty) as u8);
        let bits = self.bitcast(value, Scalar::Uint);
        let mask = self.int_of(ty, 0x7fff_ffff);
        let magnitude = self.op(Binary::And, bits, mask);
        let infinity = self.int_of(ty, 0x7f80_0000);
        self.op(op, magnitude, infinity)
    }

    pub(super) fn derivative(&mut self, axis: Axis, detail: Detail, expr: Value) -> Value {
        if self.cx.source.kind.is_vertex() {
            // In a function of Common that the checker accepted.
            let zero = self.float(0.0);
            return self.op(Binary::Multiply, expr, zero);
        }
        self.add(Op::Derivative { axis, detail, value: expr })
    }

    /// Expands `t = clamp((x - a) / (b - a), 0, 1)`, then `t t (3 - 2 t)` (section 8.3), unless the edges are known to
    /// differ.
    ///
    /// It is undefined for `a == b`, but shaders use it as a step: the quotient is infinite, and is clamped to 0 or 1.
    fn smoothstep(&mut self, ty: TypeId, a: Value, b: Value, x: Value) -> Value {
        let differ = |index| match (self.part(a, index), self.part(b, index)) {
            (PartOf::Known(a), PartOf::Known(b)) => a != b,
            _ => false,
        };
        if (0..self.extent(ty)).all(differ) {
            return self.math3(Math::SmoothStep, a, b, x);
        }
        let width = self.op(Binary::Subtract, b, a);
        let distance = self.op(Binary::Subtract, x, a);
        let quotient = self.op(Binary::Divide, distance, width);
        let t = self.math(Math::Saturate, quotient);
        let (two, three) = (self.float_of(ty, 2.0), self.float_of(ty, 3.0));
        let twice = self.op(Binary::Multiply, two, t);
        let slope = self.op(Binary::Subtract, three, twice);
        let product = self.op(Binary::Multiply, t, slope);
        self.op(Binary::Multiply, t, product)
    }

    fn modf(&mut self, args: &[ExprId]) -> Value {
        let value = self.value(args[0]);
        let place = self.place(args[1]);
        let whole = self.math(Math::Trunc, value);
        self.store_place(place, whole);
        self.op(Binary::Subtract, value, whole)
    }

    /// Lowers `st_assert(bool[, int])`: the entry point paints the number of the failed assertion.
    fn st_assert(&mut self, args: &[ExprId]) {
        let condition = self.value(args[0]);
        let number = match args.get(1) {
            Some(&number) => self.value(number),
            None => self.literal(Scalar::Int, 0),
        };
        let failed = self.cx.failed_asserts();
        let failed = self.global(failed);
        let (reject, _) = self.nested(|b| {
            let bits = b.bitcast(number, Scalar::Uint);
            // Any number other than 0 to 2 paints like 3.
            let three = b.literal(Scalar::Uint, 3);
            let bit = b.math2(Math::Min, bits, three);
            let one = b.literal(Scalar::Uint, 1);
            let flag = b.op(Binary::ShiftLeft, one, bit);
            let old = b.load(failed);
            let new = b.op(Binary::InclusiveOr, old, flag);
            b.store(failed, new);
        });
        self.push(Stmt::If { condition, accept: Block::new(), reject });
    }
}
