//! Which numbers may be zero before a program runs, and divisions by them.
//!
//! `x / 0.0` is infinite or NaN on every device, and shaders rely on it: `clamp(0.5 + (b - a) / k, 0.0, 1.0)` with `k = 0.0`
//! chooses a side. Mesa's llvmpipe takes a quotient for undefined once it sees that the divisor is zero, after it has inlined
//! functions and spread constants. So what may be such a zero is kept out of its sight.

use super::function::{Builder, PartOf};
use crate::glsl::{
    ast::List,
    hir::{
        BinaryOp, Builtin, ExprId, ExprKind, FuncId, Global, GlobalStorage, LocalKind, Module, Scalar, Stmt, StmtId,
        StmtKind, TypeId,
    },
    ir::Value,
};

/// How often all expressions are looked at. One time more is needed for each step by which a zero gets from variable to
/// variable against the order of the text, so that a chain of ten thousand would take as many.
const MOST_ROUNDS: usize = 64;

/// Says of each expression whether it, or a part of it, may be a zero that is known without running anything. Neither the order
/// of statements nor the parts of a variable are told apart: too many found cost one instruction each.
pub(super) struct Zeros {
    /// By [`ExprId::index`].
    exprs: Vec<bool>,
}

impl Zeros {
    pub fn new(module: &Module) -> Self {
        let mut search = Search {
            module,
            consts: module.consts.iter().map(|value| module[value.words].iter().any(|&word| word << 1 == 0)).collect(),
            exprs: vec![false; module.exprs.len()],
            locals: vec![false; module.locals.len()],
            globals: Vec::new(),
            functions: vec![false; module.functions.len()],
            changed: true,
        };
        let returns = returns(module);
        search.globals = module.globals.iter().map(|global| search.starts_as_zero(global)).collect();
        for (local, zero) in module.locals.iter().zip(&mut search.locals) {
            *zero = local.kind == LocalKind::Out;
        }
        for _ in 0..MOST_ROUNDS {
            if !std::mem::take(&mut search.changed) {
                return Self { exprs: search.exprs };
            }
            search.round(&returns);
        }
        // Any may be: that costs an instruction a division.
        Self { exprs: vec![true; module.exprs.len()] }
    }

    pub fn contain(&self, expr: ExprId) -> bool {
        self.exprs[expr.index()]
    }
}

/// What each function may return.
fn returns(module: &Module) -> Vec<(FuncId, ExprId)> {
    let mut found = Vec::new();
    for (index, function) in module.functions.iter().enumerate() {
        let mut pending: Vec<List<StmtId>> = function.body.into_iter().collect();
        while let Some(list) = pending.pop() {
            for &stmt in &module[list] {
                match module[stmt].kind {
                    StmtKind::Return(Some(value)) => found.push((FuncId::new(index), value)),
                    StmtKind::Block(list) => pending.push(list),
                    StmtKind::If { then, otherwise, .. } => pending.extend([then, otherwise]),
                    StmtKind::For { body, .. } | StmtKind::DoWhile { body, .. } => pending.push(body),
                    StmtKind::Switch { cases, .. } => pending.extend(module[cases].iter().map(|case| case.body)),
                    _ => {}
                }
            }
        }
    }
    found
}

struct Search<'a> {
    module: &'a Module,
    consts: Vec<bool>,
    exprs: Vec<bool>,
    locals: Vec<bool>,
    globals: Vec<bool>,
    functions: Vec<bool>,
    changed: bool,
}

impl Search<'_> {
    fn starts_as_zero(&self, global: &Global) -> bool {
        match (global.storage, global.value, global.init) {
            (_, Some(value), _) => self.consts[value.index()],
            (GlobalStorage::Private, None, Some(_)) => false,
            _ => true,
        }
    }

    fn round(&mut self, returns: &[(FuncId, ExprId)]) {
        let module = self.module;
        for (index, expr) in module.exprs.iter().enumerate() {
            let zero = self.expr(expr.kind);
            self.changed |= zero && !self.exprs[index];
            self.exprs[index] |= zero;
        }
        for Stmt { kind, .. } in &module.stmts {
            if let StmtKind::Declare { local, init } = kind {
                let zero = init.is_none_or(|init| self.is_zero(init));
                set(&mut self.locals[local.index()], zero, &mut self.changed);
            }
        }
        for (index, global) in module.globals.iter().enumerate() {
            let zero = global.init.is_some_and(|init| self.is_zero(init));
            set(&mut self.globals[index], zero, &mut self.changed);
        }
        for &(func, value) in returns {
            let zero = self.is_zero(value);
            set(&mut self.functions[func.index()], zero, &mut self.changed);
        }
    }

    fn is_zero(&self, expr: ExprId) -> bool {
        self.exprs[expr.index()]
    }

    fn any(&self, args: List<ExprId>) -> bool {
        self.module[args].iter().any(|&arg| self.is_zero(arg))
    }

    fn expr(&mut self, kind: ExprKind) -> bool {
        let module = self.module;
        match kind {
            ExprKind::Literal(bits) => bits << 1 == 0,
            ExprKind::Const(id) => self.consts[id.index()],
            ExprKind::Local(local) => self.locals[local.index()],
            ExprKind::Global(global) => self.globals[global.index()],
            ExprKind::Member { base: of, .. }
            | ExprKind::Swizzle { base: of, .. }
            | ExprKind::Index { base: of, .. }
            | ExprKind::Unary { operand: of, .. }
            | ExprKind::IncDec { place: of, .. }
            | ExprKind::Convert(of)
            | ExprKind::Splat(of)
            | ExprKind::Comma { rhs: of, .. } => self.is_zero(of),
            ExprKind::Binary { op, lhs, rhs, .. } => self.binary(op, lhs, rhs),
            ExprKind::Ternary { then, otherwise, .. } => self.is_zero(then) || self.is_zero(otherwise),
            ExprKind::Assign { place, value } => {
                let zero = self.is_zero(value);
                self.write(place, zero)
            }
            ExprKind::AssignOp { op, place, value, .. } => {
                let zero = self.binary(op, place, value);
                self.write(place, zero)
            }
            ExprKind::MatrixDiagonal(_) | ExprKind::MatrixResize(_) => true,
            ExprKind::Vector(args) | ExprKind::Matrix(args) | ExprKind::Struct(args) | ExprKind::Array(args) => {
                self.any(args)
            }
            ExprKind::Call { func, args } => {
                let first = module[func].locals.start as usize;
                for (i, (param, &arg)) in module.params(func).iter().zip(&module[args]).enumerate() {
                    let zero = param.kind != LocalKind::Out && self.is_zero(arg);
                    set(&mut self.locals[first + i], zero, &mut self.changed);
                    if param.kind.copies_out() {
                        let zero = self.locals[first + i];
                        self.write(arg, zero);
                    }
                }
                self.functions[func.index()]
            }
            ExprKind::Builtin { builtin, args } => {
                let zero = builtin < Builtin::TextureSize && self.any(args);
                if builtin == Builtin::Modf {
                    self.write(module[args][1], zero);
                }
                zero
            }
            ExprKind::Error
            | ExprKind::Uniform(_)
            | ExprKind::Knob(_)
            | ExprKind::Channel(_)
            | ExprKind::BuiltinVar(_)
            | ExprKind::Logical { .. } => false,
        }
    }

    fn binary(&self, op: BinaryOp, lhs: ExprId, rhs: ExprId) -> bool {
        let (left, right) = (self.is_zero(lhs), self.is_zero(rhs));
        match op {
            BinaryOp::Add | BinaryOp::Sub => left && right,
            BinaryOp::Mul => left || right,
            _ => left,
        }
    }

    /// Notes what is written to the variable a place is part of.
    fn write(&mut self, mut place: ExprId, zero: bool) -> bool {
        loop {
            match self.module[place].kind {
                ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } | ExprKind::Index { base, .. } => {
                    place = base
                }
                ExprKind::Local(local) => break set(&mut self.locals[local.index()], zero, &mut self.changed),
                ExprKind::Global(global) => break set(&mut self.globals[global.index()], zero, &mut self.changed),
                _ => break,
            }
        }
        zero
    }
}

fn set(flag: &mut bool, zero: bool, changed: &mut bool) {
    *changed |= zero && !*flag;
    *flag |= zero;
}

impl Builder<'_, '_> {
    /// The value of a divisor, of float type `ty`: hidden from the driver if it may be a zero that the driver could find.
    pub fn divisor(&mut self, expr: ExprId, value: Value) -> Value {
        let ty = self.cx.hir[expr].ty;
        let is_float = self.cx.hir.types.scalar(ty) == Some(Scalar::Float) && self.is_vector_or_scalar(ty);
        if !is_float || !self.cx.zeros.contain(expr) || self.is_known_not_zero(ty, value) {
            return value;
        }
        self.opaque(ty, value)
    }

    /// Whether every component is a number other than zero, which what [`Zeros`] has to say of all calls of a function together
    /// is in the one that is inlined here.
    fn is_known_not_zero(&self, ty: TypeId, value: Value) -> bool {
        (0..self.extent(ty)).all(|index| matches!(self.part(value, index), PartOf::Known(number) if number != 0.0))
    }
}
