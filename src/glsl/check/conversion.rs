//! Checks values that must have a certain type, and reports those that do not. GLSL ES has no implicit conversions, so
//! nearly every such mistake is an int instead of a float, for which a fix can be offered. GLSL 4.30 has implicit
//! conversions ([`Checker::implicit`], [`Checker::promote`]).

use super::checker::Checker;
use crate::{
    ast::{self, ExprKind as A},
    hir::{ExprId, Scalar, TypeId},
};
use eddy_diag::{Edit, Fix, Span};

impl Checker<'_> {
    /// Converts the value of an expression of the tree where the language converts implicitly (GLSL 4.30, section
    /// 4.1.10), and returns the converted value. Any other value is returned unchanged.
    pub(super) fn implicit(&mut self, written: ast::ExprId, want: TypeId) -> ExprId {
        let value = self.lowered_expr(written);
        if self.ty(value) == want || !self.converts_to(self.ty(value), want) {
            return value;
        }
        let Some((scalar, _)) = self.vector_shape(want) else { return value };
        let converted = self.convert_to(value, scalar, self.loc(value));
        self.lowered[written.index()] = Some(converted);
        converted
    }

    /// Returns whether a value of one type can be used as another: the types are equal, or the language converts
    /// implicitly.
    pub(super) fn converts_to(&self, from: TypeId, to: TypeId) -> bool {
        if from == to || !self.settings.dialect.converts() {
            return from == to;
        }
        let (Some((a, m)), Some((b, n))) = (self.vector_shape(from), self.vector_shape(to)) else { return false };
        m == n && matches!((a, b), (Scalar::Int, Scalar::Uint | Scalar::Float) | (Scalar::Uint, Scalar::Float))
    }

    /// Converts the operands of an operator to the wider component type of the two, where the language converts
    /// implicitly. With `into_left` only the right one is converted, as in `a += b`.
    pub(super) fn promote(&mut self, left: ast::ExprId, right: ast::ExprId, into_left: bool) {
        if !self.settings.dialect.converts() {
            return;
        }
        let types = &self.module.types;
        let (l, r) = (self.ty(self.lowered_expr(left)), self.ty(self.lowered_expr(right)));
        let (Some(a), Some(b)) = (types.scalar(l), types.scalar(r)) else { return };
        let of = |ty, scalar| self.vector_shape(ty).map(|(_, n)| TypeId::vector(scalar, n));
        let (on_left, on_right) = (of(l, b), of(r, a));
        if let Some(want) = on_right.filter(|&want| a != b && self.converts_to(r, want)) {
            self.implicit(right, want);
        } else if let Some(want) = on_left.filter(|&want| a != b && !into_left && self.converts_to(l, want)) {
            self.implicit(left, want);
        }
    }

    /// Returns whether `value` has type `want`; otherwise reports `message`, in which `{}` is replaced by the type
    /// found.
    pub(super) fn expect_type(
        &mut self,
        value: ExprId,
        written: ast::ExprId,
        want: TypeId,
        message: impl FnOnce(&Self) -> String,
    ) -> bool {
        let found = self.ty(value);
        if found == want {
            return true;
        }
        if found != TypeId::ERROR && want != TypeId::ERROR {
            let message = message(self);
            self.wrong_type(value, written, want, &message);
        }
        false
    }

    #[cold]
    fn wrong_type(&mut self, value: ExprId, written: ast::ExprId, want: TypeId, message: &str) {
        let found = self.ty(value);
        let loc = self.loc(value);
        let message = message.replace("{}", &format!("`{}`", self.type_name(found)));
        self.error(loc, message);
        if let Some(fix) = self.conversion_fix(value, written, want) {
            self.suggest_conversion(&fix, written);
        }
    }

    /// Adds a fix to the diagnostic reported last.
    pub(super) fn suggest_conversion(&mut self, fix: &ConversionFix, written: ast::ExprId) {
        self.hint(fix.hint());
        let edits = self.edits(fix, written);
        self.fix((!edits.is_empty()).then(|| Fix::new(fix.title(), edits)));
    }

    /// Returns the edits of a fix; none if a macro produced the value.
    fn edits(&self, fix: &ConversionFix, written: ast::ExprId) -> Vec<Edit> {
        let Some(span) = self.source_span(self.ast[written].loc) else { return Vec::new() };
        let before = |text: &str| Edit { span: Span { end: span.start, ..span }, text: text.to_owned() };
        let after = |text: &str| Edit { span: Span { start: span.end, ..span }, text: text.to_owned() };
        match fix.text.split_once("..") {
            None if fix.text.is_empty() => vec![after("u")],
            None => vec![Edit { span, text: fix.text.clone() }],
            // A component of a whole expression is selected after parentheses around it.
            Some(("", part)) => vec![before("("), after(&format!("){part}"))],
            Some((head, tail)) => vec![before(head), after(tail)],
        }
    }

    /// Reports several values of wrong types in one message; `message` is about the first, and `{}` in it is replaced
    /// by the type found.
    pub(super) fn wrong_types(&mut self, wrong: &[(ExprId, ast::ExprId, TypeId)], message: &str) {
        let Some(&(first, written, want)) = wrong.first() else { return };
        let message = message.replace("{}", &format!("`{}`", self.type_name(self.ty(first))));
        self.error(self.loc(first), message);
        let mut fixes: Vec<ConversionFix> = self.conversion_fix(first, written, want).into_iter().collect();
        let mut edits = fixes.first().map(|fix| self.edits(fix, written)).unwrap_or_default();
        for &(value, written, want) in &wrong[1..] {
            let message = format!("this must be {} too", self.with_article(want));
            if wrong.len() <= 4 {
                self.label(self.loc(value), message);
            }
            let Some(fix) = self.conversion_fix(value, written, want) else { continue };
            edits.extend(self.edits(&fix, written));
            match fixes.iter_mut().find(|m| m.converts == fix.converts && m.is_plain() && fix.is_plain()) {
                Some(known) => {
                    known.text.push_str("`, `");
                    known.text.push_str(&fix.text);
                }
                None => fixes.push(fix),
            }
        }
        fixes.iter().for_each(|fix| self.hint(fix.hint()));
        if let Some(fix) = fixes.first().filter(|_| !edits.is_empty()) {
            self.fix(Some(Fix::new(fix.title(), edits)));
        }
    }

    pub(super) fn expect_bool(&mut self, value: ExprId, written: ast::ExprId, what: &str) -> bool {
        let found = self.ty(value);
        if found == TypeId::BOOL {
            return true;
        }
        if found != TypeId::ERROR {
            let (name, loc) = (self.type_name(found), self.loc(value));
            self.error(loc, format!("{what} must be a `bool`, not `{name}`"));
            if let A::Assign { op: None, .. } = self.ast[written].kind {
                self.hint("`=` assigns; to compare write `==`");
            } else {
                match self.vector_shape(found) {
                    Some((Scalar::Float, 1)) => self.hint("compare it: `.. != 0.0`"),
                    Some((Scalar::Int, 1)) => self.hint("compare it: `.. != 0`"),
                    Some((Scalar::Uint, 1)) => self.hint("compare it: `.. != 0u`"),
                    Some((Scalar::Bool, _)) => self.hint("reduce it to one bool: `all(..)` or `any(..)`"),
                    _ => {}
                }
            }
        }
        false
    }

    /// Returns the fix that turns this value into one of type `want`.
    pub(super) fn conversion_fix(&self, value: ExprId, written: ast::ExprId, want: TypeId) -> Option<ConversionFix> {
        let found = self.ty(value);
        let (Some((from, n)), Some((to, m))) = (self.vector_shape(found), self.vector_shape(want)) else { return None };
        let target = self.type_name(want);
        let converts = (from != to).then_some((from, to));
        let named = match self.ast[written].kind {
            A::Name(symbol) => Some(self.name(symbol)),
            _ => None,
        };
        if n == m {
            if let (A::Int(value), Scalar::Uint) = (self.ast[written].kind, to)
                && value > 9999
            {
                // It was most likely written in hexadecimal, so it cannot be shown as the author wrote it.
                return Some(ConversionFix::new(converts, String::new()));
            }
            let text = self.as_scalar(written, to);
            let text = text.or_else(|| named.map(|name| format!("{target}({name})")));
            return Some(ConversionFix::new(converts, text.unwrap_or_else(|| format!("{target}(..)"))));
        }
        if n > m {
            if from != to {
                return None;
            }
            let kept = &"xyzw"[..usize::from(m)];
            return Some(ConversionFix::new(None, format!("{}.{kept}", named.unwrap_or(".."))));
        }
        if n > 1 {
            let missing = if m == 4 && n == 3 { "1.0".to_owned() } else { vec!["0.0"; usize::from(m - n)].join(", ") };
            return (from == Scalar::Float && to == from)
                .then(|| ConversionFix::new(None, format!("{target}({}, {missing})", named.unwrap_or(".."))));
        }
        let text = self.as_scalar(written, to).or_else(|| named.map(str::to_owned));
        Some(ConversionFix::new(None, format!("{target}({})", text.as_deref().unwrap_or(".."))))
    }

    /// Returns a literal (or its negative) as the author would write it in another scalar type.
    fn as_scalar(&self, written: ast::ExprId, to: Scalar) -> Option<String> {
        let (sign, literal) = match self.ast[written].kind {
            A::Unary { op: ast::UnaryOp::Minus, operand } => ("-", operand),
            _ => ("", written),
        };
        Some(match (self.ast[literal].kind, to) {
            (A::Int(v), Scalar::Float) => format!("{sign}{v}.0"),
            (A::Uint(v), Scalar::Float) => format!("{sign}{v}.0"),
            (A::Float(v), Scalar::Float) => format!("{sign}{v:?}"),
            (A::Int(v), Scalar::Uint) if sign.is_empty() && v >= 0 => format!("{v}u"),
            (A::Uint(v), Scalar::Int) if v <= i32::MAX as u32 => format!("{sign}{v}"),
            (A::Float(v), Scalar::Int) if v.fract() == 0.0 && v.abs() < 1e9 => format!("{sign}{v}"),
            (A::Float(v), Scalar::Uint) if v.fract() == 0.0 && (0.0..4e9).contains(&v) && sign.is_empty() => {
                format!("{v}u")
            }
            (A::Int(v), Scalar::Bool) => String::from(if v == 0 { "false" } else { "true" }),
            _ => return None,
        })
    }

    /// Adds, for two sides that should have the same type, the fix that turns ints into floats on the side that has
    /// them.
    pub(super) fn conversion_hint(&mut self, left: (ExprId, ast::ExprId), right: (ExprId, ast::ExprId)) {
        let (l, r) = (self.ty(left.0), self.ty(right.0));
        let rank = |scalar| match scalar {
            Scalar::Bool => 0,
            Scalar::Int => 1,
            Scalar::Uint => 2,
            Scalar::Float => 3,
        };
        let (Some(a), Some(b)) = (self.module.types.scalar(l), self.module.types.scalar(r)) else { return };
        if a == b {
            return self.size_hint(l, r);
        }
        // The literal is rewritten, or else the narrower type; a side keeps its number of components.
        let is_literal = |id: ast::ExprId| matches!(self.ast[id].kind, A::Int(_) | A::Float(_) | A::Uint(_));
        let left_changes = match (is_literal(left.1), is_literal(right.1)) {
            (true, false) if self.as_scalar(left.1, b).is_some() => true,
            (false, true) if self.as_scalar(right.1, a).is_some() => false,
            _ => rank(a) < rank(b),
        };
        let (left, right) = ((left, b), (right, a));
        let ((changed, to), other) = if left_changes { (left, right) } else { (right, left) };
        let Some(fix) = self.side_fix(changed, to) else { return };
        self.suggest_conversion(&fix, changed.1);
        // Where a float would become a whole number, the other side can become a float instead.
        let (other, wider) = other;
        if rank(to) < rank(wider)
            && let Some(fix) = self.side_fix(other, wider)
        {
            let edits = self.edits(&fix, other.1);
            self.fix((!edits.is_empty()).then(|| Fix::new(fix.title(), edits)));
        }
    }

    /// Returns the fix that turns the scalars of a value into those of another type.
    fn side_fix(&self, (value, written): (ExprId, ast::ExprId), to: Scalar) -> Option<ConversionFix> {
        let (_, n) = self.vector_shape(self.ty(value))?;
        self.conversion_fix(value, written, TypeId::vector(to, n))
    }

    fn size_hint(&mut self, l: TypeId, r: TypeId) {
        if let (Some((_, m)), Some((_, n))) = (self.vector_shape(l), self.vector_shape(r))
            && m != n
        {
            let (small, big) = (m.min(n), m.max(n));
            let target = self.type_name(if m > n { l } else { r });
            if small == 1 {
                self.hint(format!("write `{target}(..)` around the scalar"));
            } else {
                let kept = &"xyzw"[..usize::from(small)];
                self.hint(format!(
                    "take `.{kept}` of the one with {big} components, or build a `{target}` from the other"
                ));
            }
        }
    }
}

/// A replacement for a value.
pub(super) struct ConversionFix {
    /// The conversion that GLSL ES does not make implicitly, if that is the problem.
    converts: Option<(Scalar, Scalar)>,
    /// The new text, with `..` in place of the old one; empty for a literal that only needs a `u`.
    text: String,
}

impl ConversionFix {
    fn new(converts: Option<(Scalar, Scalar)>, text: String) -> Self {
        Self { converts, text }
    }

    /// Returns whether it can be listed in one line with others of its kind.
    fn is_plain(&self) -> bool {
        !self.text.is_empty() && !self.text.contains("..")
    }

    /// Returns the title of the fix, for menus.
    fn title(&self) -> String {
        match self.text.strip_prefix("..") {
            _ if self.text.is_empty() => "Add `u`".to_owned(),
            Some(part) => format!("Take `{part}`"),
            None if self.text.contains("..") => format!("Wrap in `{}`", self.text),
            None => format!("Replace with `{}`", self.text),
        }
    }

    pub(super) fn hint(&self) -> String {
        let text = &self.text;
        let what = if text.is_empty() {
            "add a `u` to the number".to_owned()
        } else if let Some(part) = text.strip_prefix("..") {
            format!("take `{part}` of it")
        } else if text.contains("..") {
            format!("write `{text}` around it")
        } else {
            format!("write `{text}`")
        };
        match self.converts {
            Some((from, to)) => {
                format!("GLSL ES has no implicit {} to {}: {what}", scalar_name(from), scalar_name(to))
            }
            None => what,
        }
    }
}

fn scalar_name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Bool => "bool",
        Scalar::Int => "int",
        Scalar::Uint => "uint",
        Scalar::Float => "float",
    }
}
