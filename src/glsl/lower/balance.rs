//! Sums and products of many variables as OpenGL's compilers write them: `x * x * x * x` as `(x * x) * (x * x)`.
//!
//! Mesa balances a chain of one operator before anything else joins its terms (`opt_rebalance_tree`), so that the last bits
//! are those of the balanced form; see [`super::regroup`] for why they matter. It is also a shorter wait for a device that does
//! several things at once.

use super::{function::Builder, operators::Typed};
use crate::glsl::hir::{BinaryOp, ExprId, ExprKind, Scalar, Shape, Type, TypeId};
use crate::glsl::ir::Value;

/// Shorter chains are left alone, as there is nothing to balance.
const SHORTEST: usize = 4;
/// Longer ones too: they are looked through for each of their links.
const LONGEST: usize = 256;

enum Tree {
    Leaf(Typed),
    Pair(Box<Tree>, Box<Tree>),
}

impl Builder<'_, '_> {
    /// The value of a chain of additions or multiplications that stands on variables alone; `None` where `expr` is no such.
    pub fn balanced(&mut self, expr: ExprId) -> Option<Value> {
        let hir = self.cx.hir;
        let ExprKind::Binary { op: op @ (BinaryOp::Add | BinaryOp::Mul), .. } = hir[expr].kind else { return None };
        let ty = hir[expr].ty;
        if hir.types.scalar(ty) != Some(Scalar::Float) || !self.is_vector_or_scalar(ty) {
            return None;
        }
        let mut leaves = Vec::new();
        self.chain_of(op, ty, expr, &mut leaves)?;
        let constants = leaves.iter().filter(|&&leaf| self.is_folded(leaf)).count();
        // Several constants are better joined.
        if leaves.len() < SHORTEST || constants > 1 {
            return None;
        }
        // A variable is read once: then drivers see which products of it are the same.
        let mut read: Vec<(ExprId, Value)> = Vec::new();
        let mut values = Vec::with_capacity(leaves.len());
        for leaf in leaves {
            let same = read.iter().find(|(other, _)| self.is_same_variable(leaf, *other)).map(|&(_, value)| value);
            let value = same.unwrap_or_else(|| self.value(leaf));
            read.push((leaf, value));
            values.push(Tree::Leaf((hir[leaf].ty, value)));
        }
        Some(self.tree(op, balance(values)).1)
    }

    /// The variables and constants of a chain, in order; `None` if there is anything else in it.
    fn chain_of(&self, op: BinaryOp, ty: TypeId, root: ExprId, leaves: &mut Vec<ExprId>) -> Option<()> {
        let hir = self.cx.hir;
        let mut pending = vec![root];
        while let Some(expr) = pending.pop() {
            if pending.len() > LONGEST {
                return None;
            }
            match hir[expr].kind {
                ExprKind::Binary {
                    op: inner,
                    shape: Shape::Same | Shape::ScalarLeft | Shape::ScalarRight,
                    lhs,
                    rhs,
                } => {
                    if inner != op || hir[expr].ty != ty {
                        return None;
                    }
                    pending.extend([rhs, lhs]);
                }
                _ if self.is_plain(expr) && leaves.len() < LONGEST => leaves.push(expr),
                _ => return None,
            }
        }
        Some(())
    }

    fn is_same_variable(&self, mut a: ExprId, mut b: ExprId) -> bool {
        let hir = self.cx.hir;
        while let (
            ExprKind::Swizzle { base: inner, swizzle },
            ExprKind::Swizzle { base: inner_of_b, swizzle: swizzle_of_b },
        ) = (hir[a].kind, hir[b].kind)
        {
            if swizzle != swizzle_of_b {
                return false;
            }
            (a, b) = (inner, inner_of_b);
        }
        match (hir[a].kind, hir[b].kind) {
            (ExprKind::Local(a), ExprKind::Local(b)) => a == b,
            (ExprKind::Global(a), ExprKind::Global(b)) => a == b,
            _ => false,
        }
    }

    fn is_folded(&self, expr: ExprId) -> bool {
        matches!(self.cx.hir[expr].kind, ExprKind::Literal(_) | ExprKind::Const(_))
    }

    /// How many links of a chain at `root`, from there on down its left side, are too long to be balanced whatever they
    /// hold.
    pub fn links_too_long(&self, root: ExprId) -> usize {
        let hir = self.cx.hir;
        let ExprKind::Binary { op, mut lhs, .. } = hir[root].kind else { return 0 };
        let mut links = 0usize;
        while let ExprKind::Binary { op: inner, lhs: next, .. } = hir[lhs].kind
            && inner == op
        {
            links += 1;
            lhs = next;
        }
        links.saturating_sub(LONGEST)
    }

    /// Whether an operand is a variable or constant to Mesa, and no expression, once what is used once stands where it is used.
    fn is_plain(&self, mut expr: ExprId) -> bool {
        let hir = self.cx.hir;
        while let ExprKind::Swizzle { base, .. } = hir[expr].kind {
            expr = base;
        }
        match hir[expr].kind {
            ExprKind::Literal(_)
            | ExprKind::Const(_)
            | ExprKind::Global(_)
            | ExprKind::Uniform(_)
            | ExprKind::Knob(_)
            | ExprKind::BuiltinVar(_) => self.is_vector_or_scalar(hir[expr].ty),
            ExprKind::Local(_) => self.is_vector_or_scalar(hir[expr].ty),
            // Filled component by component, it is a variable.
            ExprKind::Vector(args) => {
                hir[args].len() > 1 && !matches!(hir.types.get(hir[expr].ty), Type::Matrix { .. })
            }
            _ => false,
        }
    }

    fn tree(&mut self, op: BinaryOp, tree: Tree) -> Typed {
        match tree {
            Tree::Leaf(leaf) => leaf,
            Tree::Pair(left, right) => {
                let (left, right) = (self.tree(op, *left), self.tree(op, *right));
                let (shape, ty) = match (self.extent(left.0), self.extent(right.0)) {
                    (l, r) if l == r => (Shape::Same, left.0),
                    (1, _) => (Shape::ScalarLeft, right.0),
                    _ => (Shape::ScalarRight, left.0),
                };
                (ty, self.binary(op, shape, left, right))
            }
        }
    }
}

/// Warren's algorithm, which Mesa uses: neighbours are paired from the left, as many as leave a full tree, and so on.
fn balance(mut vine: Vec<Tree>) -> Tree {
    let mut left = vine.len() - 1;
    while left / 2 > 0 {
        let pairs = left / 2;
        let mut links = vine.into_iter();
        let mut next = Vec::with_capacity(links.len() - pairs);
        for _ in 0..pairs {
            let (a, b) = (links.next().expect("a link"), links.next().expect("a link"));
            next.push(Tree::Pair(Box::new(a), Box::new(b)));
        }
        next.extend(links);
        vine = next;
        left -= pairs + 1;
    }
    let last = vine.pop().expect("a chain has links");
    vine.into_iter().rev().fold(last, |rest, link| Tree::Pair(Box::new(link), Box::new(rest)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(tree: &Tree) -> String {
        match tree {
            Tree::Leaf(_) => "x".into(),
            Tree::Pair(a, b) => format!("({}{})", shape(a), shape(b)),
        }
    }

    #[test]
    fn chains_become_trees() {
        let zero = Value::new(0);
        for (count, expected) in [
            (1, "x"),
            (2, "(xx)"),
            (3, "((xx)x)"),
            (4, "((xx)(xx))"),
            (5, "((xx)((xx)x))"),
            (8, "(((xx)(xx))((xx)(xx)))"),
        ] {
            let vine = (0..count).map(|_| Tree::Leaf((TypeId::FLOAT, zero))).collect();
            assert_eq!(shape(&balance(vine)), expected);
        }
    }
}
