//! Creates nodes of the typed program, and reads and writes folded values in it.

use super::checker::Checker;
use crate::{
    ast::Loc,
    hir::{Expr, ExprFlags, ExprId, ExprKind, TypeId},
};

/// The maximum number of scalars in folded constants and their comparisons: 64 MiB, four times the largest type.
/// Without a limit a few thousand constants that each contain the previous one use all memory.
pub(super) const MAX_FOLDED_WORDS: usize = 1 << 24;

/// The scalars of a value of a keyword type, at most those of a `mat4`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ScalarWords {
    bits: [u32; 16],
    len: u8,
}

impl ScalarWords {
    /// Returns `len` zeros.
    pub(super) fn zeros(len: usize) -> Self {
        Self { len: len as u8, ..Self::default() }
    }

    pub(super) fn as_mut_slice(&mut self) -> &mut [u32] {
        &mut self.bits[..usize::from(self.len)]
    }

    pub(super) fn push(&mut self, bits: u32) {
        self.bits[usize::from(self.len)] = bits;
        self.len += 1;
    }

    pub(super) fn as_slice(&self) -> &[u32] {
        &self.bits[..usize::from(self.len)]
    }
}

impl FromIterator<u32> for ScalarWords {
    fn from_iter<I: IntoIterator<Item = u32>>(iter: I) -> Self {
        let mut words = ScalarWords::default();
        iter.into_iter().for_each(|bits| words.push(bits));
        words
    }
}

impl Checker<'_> {
    #[inline]
    pub(super) fn push(&mut self, kind: ExprKind, ty: TypeId, flags: ExprFlags, loc: Loc) -> ExprId {
        self.module.expr(Expr { kind, ty, flags, loc })
    }

    #[inline]
    pub(super) fn error_expr(&mut self, loc: Loc) -> ExprId {
        self.push(ExprKind::Error, TypeId::ERROR, ExprFlags::default(), loc)
    }

    /// Returns a scalar constant.
    #[inline]
    pub(super) fn literal(&mut self, bits: u32, ty: TypeId, loc: Loc) -> ExprId {
        self.push(ExprKind::Literal(bits), ty, ExprFlags::CONSTANT, loc)
    }

    /// Returns a folded value of any type: a `Literal` if it is a scalar.
    pub(super) fn constant(&mut self, ty: TypeId, words: &[u32], loc: Loc) -> ExprId {
        let kind = match words {
            &[bits] if self.vector_shape(ty).is_some() => ExprKind::Literal(bits),
            _ => ExprKind::Const(self.module.constant(ty, words)),
        };
        self.push(kind, ty, ExprFlags::CONSTANT, loc)
    }

    /// Returns whether this many more scalars can be folded; reports an error if not.
    pub(super) fn has_room(&mut self, words: usize, loc: Loc) -> bool {
        let before = self.folded_words;
        self.folded_words = before.saturating_add(words);
        if self.folded_words <= MAX_FOLDED_WORDS {
            return true;
        }
        if before <= MAX_FOLDED_WORDS {
            self.error(
                loc,
                format!("the constants of this program have more than {MAX_FOLDED_WORDS} numbers up to here"),
            );
            self.hint("store large tables in a buffer and read them with texelFetch");
        }
        false
    }

    /// Returns the scalars of a folded value, in memory order. `None` for the external value of a uniform, which is not
    /// a constant expression.
    #[inline]
    pub(super) fn words(&self, expr: ExprId) -> Option<&[u32]> {
        match &self.module[expr].kind {
            _ if !self.is_constant(expr) => None,
            ExprKind::Literal(bits) => Some(std::slice::from_ref(bits)),
            ExprKind::Const(id) => Some(&self.module[self.module[*id].words]),
            _ => None,
        }
    }

    #[inline]
    pub(super) fn is_constant(&self, expr: ExprId) -> bool {
        self.module[expr].flags.contains(ExprFlags::CONSTANT)
    }

    /// Returns the inherited flags of several children.
    pub(super) fn inherited(&self, children: &[ExprId]) -> ExprFlags {
        children.iter().fold(ExprFlags::default(), |sum, &child| sum | self.module[child].flags.inherited())
    }

    /// Returns an expression as a value, no longer a place: for constructors and operators without a node of their own.
    pub(super) fn as_value(&mut self, expr: ExprId) -> ExprId {
        let flags = &mut self.module[expr].flags;
        flags.remove(ExprFlags::PLACE);
        expr
    }
}
