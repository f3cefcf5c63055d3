//! Reassociation: the constants of a chain of sums or products are joined, `(a * 2.0) * 3.0` to `a * 6.0`.
//!
//! GLSL leaves the order open, and every driver regroups; which last bits come out depends on who does it first. Real shaders
//! blow up last bits (`fract(sin(x) * 43758.5453)`), so constants are joined as the GLSL compilers that people write their
//! shaders on join them, before a SPIR-V driver joins them in another order.

use super::rewrite::{self, Rewriter, Rule};
use crate::glsl::{
    ir::{Binary, Function, Module, Op, Stmt, Value},
    types::TypeId,
};

/// Chains are short; without a limit a long one would be searched for each of its links.
const DEEP: u32 = 8;

pub(super) fn run(module: &mut Module) {
    rewrite::each_function(module, |_, f| Reassociate {
        uses: use_counts(f),
        places: vec![0; f.len()],
        next: 1,
        run: 1,
    });
}

/// How many operands and statements name each value, by [`Value::index`].
fn use_counts(f: &Function) -> Vec<u32> {
    let mut uses = vec![0; f.len()];
    for (_, op) in f.values() {
        op.operands(|operand| uses[operand.index()] += 1);
    }
    let mut count = |value: Value| uses[value.index()] += 1;
    f.each_statement(&mut |stmt| match stmt {
        Stmt::Store { place, value } => [*place, *value].into_iter().for_each(&mut count),
        Stmt::If { condition: value, .. } | Stmt::Switch { selector: value, .. } => count(*value),
        Stmt::Loop { break_if: value, .. } | Stmt::Return(value) => value.iter().for_each(|value| count(*value)),
        Stmt::Output(parts) => parts.iter().for_each(|(_, value)| count(*value)),
        Stmt::Let(_) | Stmt::Break | Stmt::Continue | Stmt::Discard => {}
    });
    uses
}

struct Reassociate {
    uses: Vec<u32>,
    /// Where each value comes in the order of computation, from 1 on; 0: it is new.
    places: Vec<u32>,
    next: u32,
    /// The place at which the run of statements without branches begins that is at hand.
    run: u32,
}

impl Reassociate {
    /// Whether a chain may be taken apart: what is used elsewhere is not computed twice, and nothing moves into a branch or loop.
    fn is_free(&self, chain: Value) -> bool {
        let at = chain.index();
        self.uses.get(at).is_none_or(|&uses| uses == 1)
            && self.places.get(at).is_none_or(|&place| place == 0 || place >= self.run)
    }

    /// Puts a constant beside the first one of a chain, in the place of that one's neighbour: the chain and the neighbour.
    fn joined(
        &self,
        r: &mut Rewriter<'_>,
        op: Binary,
        chain: Value,
        constant: f32,
        depth: u32,
    ) -> Option<(Value, Value)> {
        let Op::Binary { op: inner, left, right } = r.f[chain] else { return None };
        if inner != op || depth > DEEP || !self.is_free(chain) {
            return None;
        }
        let (known, neighbour) = match (r.number(left), r.number(right)) {
            (Some(known), None) => (known, right),
            (None, Some(known)) => (known, left),
            (Some(_), Some(_)) => return None,
            (None, None) => {
                if let Some((part, freed)) = self.joined(r, op, left, constant, depth + 1) {
                    return Some((r.add(Op::Binary { op, left: part, right }), freed));
                }
                let (part, freed) = self.joined(r, op, right, constant, depth + 1)?;
                return Some((r.add(Op::Binary { op, left, right: part }), freed));
            }
        };
        let joined = if op == Binary::Multiply { known * constant } else { known + constant };
        // What overflows only in this order must not.
        joined.is_finite().then(|| (r.float(joined), neighbour))
    }
}

impl Rule for Reassociate {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        self.places[value.index()] = self.next;
        self.next += 1;
        let Op::Binary { op: op @ (Binary::Add | Binary::Multiply), left, right } = *op else { return None };
        if r.f.ty(value) != TypeId::FLOAT {
            return None;
        }
        let (chain, constant) = match (r.number(left), r.number(right)) {
            (None, Some(constant)) => (left, constant),
            (Some(constant), None) => (right, constant),
            _ => return None,
        };
        let (joined, freed) = self.joined(r, op, chain, constant, 0)?;
        // What is freed comes where the constant was: it is the first operand that drivers move further constants to.
        let (left, right) = if chain == left { (joined, freed) } else { (freed, joined) };
        let value = r.add(Op::Binary { op, left, right });
        Some(value)
    }

    fn enter(&mut self) {
        self.run = self.next;
    }

    fn join(&mut self, _: &Rewriter<'_>) {
        self.run = self.next;
    }
}
