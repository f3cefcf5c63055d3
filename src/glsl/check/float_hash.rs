//! Detects hashes of the form `fract(sin(x) * large)`, which differ on every GPU, and offers an integer hash instead.
//!
//! Vulkan allows `sin` and `cos` an absolute error of 2^-11 within -pi to pi and specifies nothing for larger angles
//! (Vulkan 1.3, "Precision of Individual Operations"). A large factor scales that error beyond 1, and `fract` keeps the
//! remainder.

use super::checker::Checker;
use crate::{
    ast::{Loc, Symbol},
    builtins::{Builtin, Operation},
    hir::{BinaryOp, ExprId, ExprKind, FuncId, LocalId, Scalar, StmtKind, TypeId, UnaryOp, VarFlags},
    ir::Math,
};
use eddy_diag::{Edit, Fix, Span};

/// The smallest factor that is reported: the allowed error times 256 is an eighth of the range of `fract`.
const MIN_FACTOR: f32 = 256.0;

/// An angle whose sine is hashed.
struct Hash {
    /// `sin`, `cos` or `tan`.
    function: Builtin,
    angle: ExprId,
    factor: f32,
    /// Nothing that varies is added to the product, so that a hash of the angle can replace the whole expression.
    is_alone: bool,
}

/// The value that an integer hash takes instead of an angle.
struct Input {
    ty: TypeId,
    /// The span of its text, or the name of the variable.
    text: Result<Span, Symbol>,
    /// Distinguishes hashes of the same value that have different constants.
    seed: u32,
}

impl Checker<'_> {
    /// Reports every such hash in the functions of an error-free program: once per place, and once per macro.
    pub(super) fn finish_float_hashes(&mut self) {
        let mut in_macros: Vec<Span> = Vec::new();
        for func in self.module.call_order.clone() {
            for at in self.module[func].exprs.clone() {
                let at = ExprId::new(at as usize);
                let Some(hash) = self.float_hash(at) else { continue };
                let loc = self.module[at].loc;
                if let Some((span, _)) = self.origins.definition_span(loc) {
                    if in_macros.contains(&span) {
                        continue;
                    }
                    in_macros.push(span);
                }
                let (name, factor) = (hash.function.name, hash.factor);
                let message =
                    format!("differs between GPUs: a fraction of `{name}` times {factor} depends on its last bits");
                self.note(loc, message);
                self.hint("hash integers or the bits of a float (`floatBitsToUint`): they are the same on every GPU");
                let fix = self.integer_hash(func, at, &hash);
                self.fix(fix);
            }
        }
    }

    /// Returns the hash that an expression computes: `fract` or `mod(.., 1.0)` of a large multiple of a sine.
    fn float_hash(&self, at: ExprId) -> Option<Hash> {
        let ExprKind::Builtin { builtin, args } = self.module[at].kind else { return None };
        let args = &self.module[args];
        match builtin.operation {
            Operation::Function(Math::Fract) => {}
            Operation::Modulo if self.constant_words(args[1]).is_some_and(|w| *w == [1f32.to_bits()]) => {}
            _ => return None,
        }
        let mut open = vec![(args[0], 1.0, true)];
        while let Some((at, factor, is_alone)) = open.pop() {
            match self.module[at].kind {
                ExprKind::Binary { op: op @ (BinaryOp::Mul | BinaryOp::Div), lhs, rhs, .. } => {
                    if let Some(by) = self.largest_component(rhs) {
                        open.push((lhs, if op == BinaryOp::Mul { factor * by } else { factor / by }, is_alone));
                    } else if let (Some(by), BinaryOp::Mul) = (self.largest_component(lhs), op) {
                        open.push((rhs, factor * by, is_alone));
                    }
                }
                ExprKind::Binary { op: BinaryOp::Add | BinaryOp::Sub, lhs, rhs, .. } => {
                    let is_alone =
                        is_alone && (self.largest_component(lhs).is_some() || self.largest_component(rhs).is_some());
                    open.extend([(lhs, factor, is_alone), (rhs, factor, is_alone)]);
                }
                ExprKind::Unary { op: UnaryOp::Negate, operand } => open.push((operand, factor, is_alone)),
                ExprKind::Swizzle { base, .. } => open.push((base, factor, false)),
                ExprKind::Builtin { builtin, args } => match builtin.operation {
                    Operation::Function(Math::Abs) => open.push((self.module[args][0], factor, is_alone)),
                    Operation::Function(Math::Sin | Math::Cos | Math::Tan) if factor >= MIN_FACTOR => {
                        return Some(Hash { function: builtin, angle: self.module[args][0], factor, is_alone });
                    }
                    _ => {}
                },
                _ => {}
            }
        }
        None
    }

    /// Returns the largest magnitude among the components of a constant.
    fn largest_component(&self, at: ExprId) -> Option<f32> {
        let words = self.constant_words(at)?;
        Some(words.iter().map(|bits| f32::from_bits(*bits).abs()).fold(0.0, f32::max))
    }

    fn constant_words(&self, at: ExprId) -> Option<Vec<u32>> {
        match self.module[at].kind {
            ExprKind::Literal(bits) => Some(vec![bits]),
            ExprKind::Const(id) => Some(self.module[self.module[id].words].to_vec()),
            _ => None,
        }
    }

    /// Returns the fix that replaces a float hash with an integer hash of its angle: the call, and the helper function
    /// before the calling function, unless it already exists.
    fn integer_hash(&self, func: FuncId, at: ExprId, hash: &Hash) -> Option<Fix> {
        let whole = self.source_span(self.module[at].loc).filter(|_| hash.is_alone)?;
        let input = self.input(func, hash.angle)?;
        let (from, to) = (self.float_components(input.ty)?, self.float_components(self.module[at].ty)?);
        let name = format!("pcgHash{to}{from}");
        let before = self.source_span(self.module[func].loc)?;
        let mut edits = Vec::new();
        match self.names.find(&name) {
            None if before.source == whole.source => {
                let text = helper(&name, from, to);
                edits.push(Edit { span: Span::at(before.source, before.start as usize), text });
            }
            Some(symbol) if self.is_helper(symbol, func, input.ty, self.module[at].ty) => {}
            _ => return None,
        }
        let seed = input.seed;
        match input.text {
            Ok(kept) => edits.extend([
                Edit { span: Span { end: kept.start, ..whole }, text: format!("{name}(") },
                Edit { span: Span { start: kept.end, ..whole }, text: format!(", {seed}u)") },
            ]),
            Err(symbol) => {
                edits.push(Edit { span: whole, text: format!("{name}({}, {seed}u)", self.name(symbol)) });
            }
        }
        Some(Fix::new(format!("Replace with the integer hash `{name}`"), edits))
    }

    /// Returns whether a name is that of the function which an earlier fix inserted before this one.
    fn is_helper(&self, name: Symbol, user: FuncId, from: TypeId, to: TypeId) -> bool {
        let first = self.module[user].loc.first;
        (0..self.module.functions.len()).map(FuncId::new).any(|func| {
            let function = &self.module[func];
            let params = self.module.params(func).iter().map(|param| param.ty);
            function.name.symbol == name
                && function.loc.first < first
                && function.result == to
                && params.eq([from, TypeId::UINT])
        })
    }

    /// Returns the number of components of a float or a vector of floats.
    fn float_components(&self, ty: TypeId) -> Option<u32> {
        let size = self.module.types.components(ty)?;
        (size <= 4 && ty == TypeId::vector(Scalar::Float, size as u8)).then_some(size)
    }

    /// Returns the input of the new hash: the variable in an angle, without the constants that it is scaled by. The
    /// last bits of the product differ between GPUs, too, which may fuse its operations.
    fn input(&self, func: FuncId, angle: ExprId) -> Option<Input> {
        let (mut at, mut seed, mut by_name) = (angle, 0u32, None);
        loop {
            let expr = &self.module[at];
            match expr.kind {
                ExprKind::Binary { op: op @ (BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul), lhs, rhs, .. } => {
                    let (of, words) = match (self.constant_words(lhs), self.constant_words(rhs)) {
                        (None, Some(words)) => (lhs, words),
                        (Some(words), None) => (rhs, words),
                        _ => break,
                    };
                    // If a scalar is combined with a vector, the components differ.
                    if self.module[of].ty != expr.ty {
                        break;
                    }
                    (at, seed) = (of, mixed(mixed(seed, &[op as u32]), &words));
                }
                ExprKind::Builtin { builtin, .. } if matches!(builtin.operation, Operation::Dot) => {
                    let (of, words) = self.of_dot(at)?;
                    (at, seed) = (of, mixed(seed, &words));
                    if self.has_dot(of) {
                        return None;
                    }
                    break;
                }
                // The dot products of one variable with several constants.
                ExprKind::Vector(args) => {
                    let dots: Option<Vec<_>> = self.module[args].iter().map(|arg| self.of_dot(*arg)).collect();
                    let Some(dots) = dots else { break };
                    let locals = |of: &ExprId| match self.module[*of].kind {
                        ExprKind::Local(id) => Some(id),
                        _ => None,
                    };
                    let first = locals(&dots[0].0)?;
                    if dots.iter().any(|(of, _)| locals(of) != Some(first)) {
                        return None;
                    }
                    for (_, words) in &dots {
                        seed = mixed(seed, words);
                    }
                    at = dots[0].0;
                    break;
                }
                // A variable whose value is such a product.
                ExprKind::Local(local) if by_name.is_none() => match self.only_value(local) {
                    Some(value) if self.has_dot(value) => (at, by_name) = (value, Some(local)),
                    _ => break,
                },
                _ => break,
            }
        }
        let expr = &self.module[at];
        if self.has_dot(at) || matches!(expr.kind, ExprKind::Comma { .. }) {
            return None;
        }
        if let ExprKind::Local(local) = expr.kind {
            if self.is_assigned_dot(func, local) {
                return None;
            }
            if by_name.is_some() {
                let symbol = self.steady_name(func, local)?;
                return Some(Input { ty: expr.ty, text: Err(symbol), seed: seed & 0xffff });
            }
        }
        let written = self.source_span(expr.loc).filter(|_| by_name.is_none())?;
        Some(Input { ty: expr.ty, text: Ok(written), seed: seed & 0xffff })
    }

    /// Returns the variable side of a dot product with a constant, and the constant.
    fn of_dot(&self, at: ExprId) -> Option<(ExprId, Vec<u32>)> {
        let ExprKind::Builtin { builtin, args } = self.module[at].kind else { return None };
        let &[a, b] = &self.module[args] else { return None };
        if !matches!(builtin.operation, Operation::Dot) {
            return None;
        }
        match (self.constant_words(a), self.constant_words(b)) {
            (None, Some(words)) => Some((a, words)),
            (Some(words), None) => Some((b, words)),
            _ => None,
        }
    }

    fn has_dot(&self, at: ExprId) -> bool {
        let mut open = vec![at];
        while let Some(at) = open.pop() {
            if let ExprKind::Builtin { builtin, .. } = self.module[at].kind
                && matches!(builtin.operation, Operation::Dot)
            {
                return true;
            }
            self.module.parts(at, &mut open);
        }
        false
    }

    /// Returns the value that a variable is declared with, if it never changes.
    fn only_value(&self, local: LocalId) -> Option<ExprId> {
        if self.module[local].flags.contains(VarFlags::WRITTEN) {
            return None;
        }
        self.module.stmts.iter().find_map(|stmt| match stmt.kind {
            StmtKind::Declare { local: of, init } if of == local => init,
            _ => None,
        })
    }

    fn is_assigned_dot(&self, func: FuncId, local: LocalId) -> bool {
        self.only_value(local).is_some_and(|value| self.has_dot(value))
            || self.module[func].exprs.clone().any(|at| match self.module[ExprId::new(at as usize)].kind {
                ExprKind::Assign { place, value } | ExprKind::AssignOp { place, value, .. } => {
                    let root = self.module.root(place);
                    matches!(self.module[root].kind, ExprKind::Local(of) if of == local) && self.has_dot(value)
                }
                _ => false,
            })
    }

    /// Returns the name of a variable if it is never written and no other variable of the function has the same name.
    fn steady_name(&self, func: FuncId, local: LocalId) -> Option<Symbol> {
        let symbol = self.module[local].name?.symbol;
        let range = self.module[func].locals.clone();
        let same = self.module.locals[range.start as usize..range.end as usize]
            .iter()
            .filter(|other| other.name.is_some_and(|name| name.symbol == symbol))
            .count();
        (same == 1 && !self.module[local].flags.contains(VarFlags::WRITTEN)).then_some(symbol)
    }

    #[cold]
    fn note(&mut self, loc: Loc, message: String) {
        let note = self.origins.note(self.names, loc, message);
        self.diagnostics.push(note);
    }
}

/// Computes FNV-1a over words (G. Fowler, L. C. Noll, K.-P. Vo, 1991).
fn mixed(seed: u32, words: &[u32]) -> u32 {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let mixed = bytes.fold(seed ^ 0x811c_9dc5, |mixed, byte| (mixed ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    mixed ^ mixed >> 16
}

/// Returns a function of GLSL ES 3.00 that computes `to` numbers in 0..1 from the bits of `from` floats.
fn helper(name: &str, from: u32, to: u32) -> String {
    let vector = |scalar: &str, vector: &str, size: u32| match size {
        1 => scalar.to_owned(),
        _ => format!("{vector}{size}"),
    };
    let (result, floats, uints) =
        (vector("float", "vec", to), vector("float", "vec", from), vector("uint", "uvec", from));
    let is_nonzero = match from {
        1 => "p != 0.0".to_owned(),
        _ => format!("notEqual(p, {floats}(0.0))"),
    };
    let words = match from {
        1 => "bits, seed, 0u, 0u",
        2 => "bits, seed, 0u",
        3 => "bits, seed",
        _ => "bits ^ seed",
    };
    let parts = ["v.x", "v.xy", "v.xyz", "v"][to as usize - 1];
    format!(
        "// From 0 to 1, by the bits of p, and the same on every GPU: pcg4d (M. Jarzynski, M. Olano, \"Hash Functions for GPU\n\
         // Rendering\", JCGT 9(3), 2020).\n\
         {result} {name}({floats} p, uint seed) {{\n    \
             {uints} bits = floatBitsToUint(p) * {uints}({is_nonzero}); // -0.0 is 0.0\n    \
             bits ^= bits >> 16u; // whole numbers differ in the upper bits alone\n    \
             uvec4 v = uvec4({words}) * 1664525u + 1013904223u;\n    \
             v.x += v.y * v.w;\n    v.y += v.z * v.x;\n    v.z += v.x * v.y;\n    v.w += v.y * v.z;\n    \
             v ^= v >> 16u;\n    \
             v.x += v.y * v.w;\n    v.y += v.z * v.x;\n    v.z += v.x * v.y;\n    v.w += v.y * v.z;\n    \
             return {result}({parts} >> 8u) / 16777216.0;\n\
         }}\n\n"
    )
}
