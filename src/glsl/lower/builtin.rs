//! Built-in functions of chapter 8, textures excepted.

use super::function::{Builder, PartOf};
use crate::{
    hir::{Builtin, ExprId, Scalar, TypeId},
    ir::{Axis, Binary, Block, Math, Op, Stmt, Value},
};

impl Builder<'_, '_> {
    pub fn math(&mut self, fun: Math, arg: Value) -> Value {
        self.add(Op::Math { fun, arg, arg1: None, arg2: None, arg3: None })
    }

    pub fn math2(&mut self, fun: Math, arg: Value, arg1: Value) -> Value {
        self.add(Op::Math { fun, arg, arg1: Some(arg1), arg2: None, arg3: None })
    }

    pub fn math3(&mut self, fun: Math, arg: Value, arg1: Value, arg2: Value) -> Value {
        self.add(Op::Math { fun, arg, arg1: Some(arg1), arg2: Some(arg2), arg3: None })
    }

    /// Calls a built-in of result type `ty`; `None` for void ones.
    pub fn builtin(&mut self, builtin: Builtin, ty: TypeId, args: &[ExprId]) -> Option<Value> {
        if builtin.is_texture() {
            return Some(self.texture(builtin, ty, args));
        }
        match builtin {
            Builtin::Modf => return Some(self.modf(args)),
            Builtin::StAssert => {
                self.st_assert(args);
                return None;
            }
            _ => {}
        }
        let hir = self.cx.hir;
        let mut values = [None; 3];
        for (value, &arg) in values.iter_mut().zip(args) {
            *value = Some((hir[arg].ty, self.value(arg)));
        }
        let (first_ty, a) = values[0].expect("every built-in has an argument");
        Some(match (values[1], values[2]) {
            (None, _) => self.unary_builtin(builtin, first_ty, a),
            (Some(b), None) => self.binary_builtin(builtin, ty, (first_ty, a), b),
            (Some((_, b)), Some(c)) => self.ternary_builtin(builtin, ty, (first_ty, a), b, c),
        })
    }

    fn unary_builtin(&mut self, builtin: Builtin, ty: TypeId, a: Value) -> Value {
        use Builtin as B;
        let fun = match builtin {
            B::Radians => Math::Radians,
            B::Degrees => Math::Degrees,
            B::Sin => Math::Sin,
            B::Cos => Math::Cos,
            B::Tan => Math::Tan,
            B::Asin => Math::Asin,
            B::Acos => Math::Acos,
            B::Atan => Math::Atan,
            B::Sinh => Math::Sinh,
            B::Cosh => Math::Cosh,
            B::Tanh => Math::Tanh,
            B::Asinh => Math::Asinh,
            B::Acosh => Math::Acosh,
            B::Atanh => Math::Atanh,
            B::Exp => Math::Exp,
            B::Log => Math::Log,
            B::Exp2 => Math::Exp2,
            B::Log2 => Math::Log2,
            B::Sqrt => Math::Sqrt,
            B::InverseSqrt => Math::InverseSqrt,
            B::Abs => Math::Abs,
            B::Sign => Math::Sign,
            B::Floor => Math::Floor,
            B::Trunc => Math::Trunc,
            // `round` may go either way at halves.
            B::Round | B::RoundEven => Math::Round,
            B::Ceil => Math::Ceil,
            B::Fract => Math::Fract,
            B::Transpose => Math::Transpose,
            B::PackSnorm2x16 => Math::Pack2x16snorm,
            B::PackUnorm2x16 => Math::Pack2x16unorm,
            B::PackHalf2x16 => Math::Pack2x16float,
            B::UnpackSnorm2x16 => Math::Unpack2x16snorm,
            B::UnpackUnorm2x16 => Math::Unpack2x16unorm,
            B::UnpackHalf2x16 => Math::Unpack2x16float,
            // A unit "vector" of one component is its sign.
            B::Normalize if ty == TypeId::FLOAT => Math::Sign,
            B::Normalize => return self.normalize(ty, a),
            B::Length => return self.length(ty, a),
            B::Inverse => return self.inverse(ty, a),
            B::Determinant => return self.determinant(ty, a),
            B::FloatBitsToInt => return self.bitcast(a, Scalar::Int),
            B::FloatBitsToUint => return self.bitcast(a, Scalar::Uint),
            B::IntBitsToFloat | B::UintBitsToFloat => return self.bitcast(a, Scalar::Float),
            B::IsNan => return self.exponent_test(Binary::Greater, ty, a),
            B::IsInf => return self.exponent_test(Binary::Equal, ty, a),
            B::Not => return self.not(a),
            B::Any | B::All => {
                return self.add(if builtin == B::Any { Op::Any(a) } else { Op::All(a) });
            }
            B::DFdx => return self.derivative(Axis::X, a),
            B::DFdy => return self.derivative(Axis::Y, a),
            B::Fwidth => return self.derivative(Axis::Width, a),
            other => unreachable!("{other:?} takes more than one argument"),
        };
        self.math(fun, a)
    }

    /// `ty` is the result's; one side may be a scalar where it is a vector.
    fn binary_builtin(
        &mut self,
        builtin: Builtin,
        ty: TypeId,
        (a_ty, a): (TypeId, Value),
        b: (TypeId, Value),
    ) -> Value {
        use Builtin as B;
        let (b_ty, b) = b;
        let fit = |this: &mut Self, value, from| if from == ty { value } else { this.splat(value, ty) };
        match builtin {
            B::Atan => self.math2(Math::Atan2, a, b),
            B::Pow => self.math2(Math::Pow, a, b),
            B::Min | B::Max => {
                let b = fit(self, b, b_ty);
                self.math2(if builtin == B::Min { Math::Min } else { Math::Max }, a, b)
            }
            B::Step => {
                // Zero for NaN on either side, as OpenGL drivers have it; SPIR-V's `Step` may say one.
                let a = fit(self, a, a_ty);
                let reached = self.op(Binary::GreaterEqual, b, a);
                self.add(Op::Convert { value: reached, to: Scalar::Float })
            }
            B::Mod => {
                // x - y * floor(x / y): naga's remainder truncates. Where y is a constant zero drivers drop the
                // product, and x is left: shaders repeat space along some axes alone by it, so that divisor must stay
                // in sight.
                let b = fit(self, b, b_ty);
                let quotient = self.op(Binary::Divide, a, b);
                let whole = self.math(Math::Floor, quotient);
                let multiple = self.op(Binary::Multiply, b, whole);
                self.op(Binary::Subtract, a, multiple)
            }
            B::Distance => {
                let difference = self.op(Binary::Subtract, a, b);
                self.length(a_ty, difference)
            }
            B::Dot => self.dot(a_ty, a, b),
            B::Cross => self.math2(Math::Cross, a, b),
            B::Reflect => self.reflect(ty, a, b),
            B::MatrixCompMult => self.matrix_comp_mult(a_ty, a, b),
            B::OuterProduct => self.outer_product(ty, b_ty, a, b),
            B::LessThan => self.op(Binary::Less, a, b),
            B::LessThanEqual => self.op(Binary::LessEqual, a, b),
            B::GreaterThan => self.op(Binary::Greater, a, b),
            B::GreaterThanEqual => self.op(Binary::GreaterEqual, a, b),
            B::Equal => self.op(Binary::Equal, a, b),
            B::NotEqual => {
                // Not `!=`: naga's is false for NaN.
                let equal = self.op(Binary::Equal, a, b);
                self.not(equal)
            }
            other => unreachable!("{other:?} does not take two arguments"),
        }
    }

    fn ternary_builtin(
        &mut self,
        builtin: Builtin,
        ty: TypeId,
        a: (TypeId, Value),
        b: Value,
        c: (TypeId, Value),
    ) -> Value {
        use Builtin as B;
        let ((a_ty, a), (c_ty, c)) = (a, c);
        match builtin {
            B::Clamp => {
                // The limits have one type, that of the first argument or its component's.
                let spread = c_ty != ty;
                let (b, c) = if spread { (self.splat(b, ty), self.splat(c, ty)) } else { (b, c) };
                self.math3(Math::Clamp, a, b, c)
            }
            B::Mix => match self.cx.hir.types.scalar(c_ty) {
                Some(Scalar::Bool) => self.select(c, b, a),
                _ => {
                    let c = if c_ty == ty { c } else { self.splat(c, ty) };
                    self.math3(Math::Mix, a, b, c)
                }
            },
            B::Smoothstep => {
                // The edges have one type; the third argument has the result's.
                let spread = a_ty != ty;
                let (a, b) = if spread { (self.splat(a, ty), self.splat(b, ty)) } else { (a, b) };
                self.smoothstep(ty, a, b, c)
            }
            B::FaceForward if ty == TypeId::FLOAT => {
                let product = self.op(Binary::Multiply, c, b);
                let zero = self.float(0.0);
                let faces = self.op(Binary::Less, product, zero);
                let minus = self.float(-1.0);
                let turned = self.op(Binary::Multiply, a, minus);
                self.select(faces, a, turned)
            }
            B::FaceForward => self.math3(Math::FaceForward, a, b, c),
            B::Refract => self.refract(ty, a, b, c),
            other => unreachable!("{other:?} does not take three arguments"),
        }
    }

    /// Adds `isnan` or `isinf` by the bits: a driver that takes all floats for finite folds the tests themselves away.
    fn exponent_test(&mut self, op: Binary, ty: TypeId, value: Value) -> Value {
        let ty = TypeId::vector(Scalar::Uint, self.extent(ty) as u8);
        let bits = self.bitcast(value, Scalar::Uint);
        let mask = self.int_of(ty, 0x7fff_ffff);
        let magnitude = self.op(Binary::And, bits, mask);
        let infinity = self.int_of(ty, 0x7f80_0000);
        self.op(op, magnitude, infinity)
    }

    fn derivative(&mut self, axis: Axis, expr: Value) -> Value {
        if self.cx.source.kind.is_vertex() {
            // Of a function of Common that the checker let pass.
            let zero = self.float(0.0);
            return self.op(Binary::Multiply, expr, zero);
        }
        self.add(Op::Derivative { axis, value: expr })
    }

    /// Writes out `t = clamp((x - a) / (b - a), 0, 1)`, then `t t (3 - 2 t)` (section 8.3), where the edges are not
    /// known to differ.
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

    /// `st_assert(bool[, int])`: the entry point paints what failed.
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
            // Any other number than 0 to 2 paints like 3.
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
