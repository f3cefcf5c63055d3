//! Expressions: the loop over the tree's arena, names, and the kinds whose rules are not in files of their own.

use super::{checker::Checker, scope::Binding};
use crate::{
    ast::{self, ExprKind as A, List, Loc, MAX_NESTING, Symbol, TokenId},
    hir::{self, DeclRef, ExprFlags, ExprId, ExprKind, GlobalStorage, IncDec, LocalKind, Type, TypeId, VarFlags},
};

impl<'a> Checker<'a> {
    /// Checks one full expression and everything in it.
    pub(super) fn expr(&mut self, root: ast::ExprId) -> ExprId {
        if let Some(done) = self.lowered[root.index()] {
            return done;
        }
        self.full_expr = self.module.exprs.len();
        let first = self.first_of(root);
        if self.broken_tree {
            self.expr_in_broken_tree(first, root.index());
        } else {
            for i in first..=root.index() {
                self.node(i);
            }
        }
        if !self.pending_channels.is_empty() {
            self.report_pending_channels();
        }
        // There is at least one node per level, so most expressions need no further check.
        if root.index() - first >= MAX_NESTING as usize && self.height(first, root) > MAX_NESTING {
            return self.too_deep(root);
        }
        self.lowered[root.index()].expect("the root is in the range")
    }

    /// Returns the number of levels of the tree under `root`, not counting left spines and folded constants.
    fn height(&self, first: usize, root: ast::ExprId) -> u32 {
        let ast = self.ast;
        let mut heights: Vec<u32> = Vec::with_capacity(root.index() + 1 - first);
        for (expr, lowered) in ast.exprs[first..=root.index()].iter().zip(&self.lowered[first..]) {
            let of = |id: ast::ExprId| id.index().checked_sub(first).map_or(0, |i| heights[i]);
            let list = |args: List<ast::ExprId>| ast[args].iter().map(|&a| of(a) + 1).max().unwrap_or(0);
            let is_constant =
                lowered.is_none_or(|id| matches!(self.module[id].kind, ExprKind::Literal(_) | ExprKind::Const(_)));
            heights.push(match expr.kind {
                _ if is_constant => 0,
                A::Call { args, .. } | A::Construct { args, .. } => list(args),
                A::Method { base, .. } | A::Member { base, .. } => of(base),
                A::Index { base, index } => of(base).max(of(index) + 1),
                A::Unary { operand, .. } => of(operand) + 1,
                A::Postfix { operand, .. } => of(operand),
                A::Binary { lhs, rhs, .. } | A::Comma { lhs, rhs } => of(lhs).max(of(rhs) + 1),
                A::Assign { place, value, .. } => of(place).max(of(value)) + 1,
                A::Ternary { cond, then, otherwise } => of(cond).max(of(then)).max(of(otherwise)) + 1,
                _ => 0,
            });
        }
        heights.last().copied().unwrap_or(0) + 1
    }

    /// Rejects an expression whose tree is too deep. Nothing visits the tree afterwards: the passes over programs
    /// recurse as deep as their trees.
    #[cold]
    fn too_deep(&mut self, root: ast::ExprId) -> ExprId {
        let loc = self.ast[root].loc;
        if !std::mem::replace(&mut self.reported_too_deep, true) {
            self.error(loc, format!("this is nested more than {MAX_NESTING} levels deep"));
            self.hint("move a part of it to a variable or a function");
        }
        let id = self.error_expr(loc);
        self.lowered[root.index()] = Some(id);
        id
    }

    /// Returns the first node of an expression: in post-order, its leftmost leaf.
    fn first_of(&self, root: ast::ExprId) -> usize {
        let mut at = root;
        loop {
            let mut first = None;
            self.ast.parts(at, |part| first = first.or(Some(part)));
            match first {
                Some(part) => at = part,
                None => return at.index(),
            }
        }
    }

    /// Checks an expression of a tree that had syntax errors: between its nodes there may be discarded ones, so only
    /// those reachable from the root are checked.
    #[cold]
    fn expr_in_broken_tree(&mut self, first: usize, root: usize) {
        let mut wanted = vec![false; root + 1 - first];
        wanted[root - first] = true;
        for i in (first..=root).rev() {
            if !wanted[i - first] {
                continue;
            }
            self.ast.parts(ast::ExprId::new(i), |part| {
                if let Some(at) = part.index().checked_sub(first) {
                    wanted[at] = true;
                }
            });
        }
        for (i, _) in wanted.into_iter().enumerate().filter(|(_, wanted)| *wanted) {
            self.node(first + i);
        }
    }

    /// Returns the HIR of a child that has been checked.
    #[inline]
    pub(super) fn lowered_expr(&self, id: ast::ExprId) -> ExprId {
        self.lowered[id.index()].expect("children come first")
    }

    fn node(&mut self, index: usize) {
        if self.lowered[index].is_some() {
            return;
        }
        let ast::Expr { kind, loc } = self.ast.exprs[index];
        let id = match kind {
            A::Error => self.error_expr(loc),
            A::Int(value) => self.literal(value as u32, TypeId::INT, loc),
            A::Uint(value) => self.literal(value, TypeId::UINT, loc),
            A::Float(value) => self.literal(value.to_bits(), TypeId::FLOAT, loc),
            A::Bool(value) => self.literal(u32::from(value), TypeId::BOOL, loc),
            A::Name(symbol) => self.named(symbol, loc),
            A::Call { name, args } => self.call(name, args, loc),
            A::Construct { ty, args } => self.construct(ty, args, loc),
            A::Method { base, name } => self.method(self.lowered_expr(base), name, loc),
            A::Member { base, name } => self.member(self.lowered_expr(base), name, loc),
            A::Index { base, index } => self.index(self.lowered_expr(base), self.lowered_expr(index), loc),
            A::Unary { op, operand } => self.unary(op, operand, loc),
            A::Postfix { op, operand } => {
                let op = match op {
                    ast::PostfixOp::Increment => IncDec::PostIncrement,
                    ast::PostfixOp::Decrement => IncDec::PostDecrement,
                };
                self.inc_dec(op, self.lowered_expr(operand), loc)
            }
            A::Binary { op, lhs, rhs } => self.binary(op, lhs, rhs, loc),
            A::Assign { op, place, value } => self.assign(op, place, value, loc),
            A::Ternary { cond, then, otherwise } => self.ternary(cond, then, otherwise, loc),
            A::Comma { lhs, rhs } => self.comma(self.lowered_expr(lhs), self.lowered_expr(rhs), loc),
        };
        self.lowered[index] = Some(id);
    }

    // --------------------------------------------------------------------------------------------------------- names

    #[inline]
    fn named(&mut self, symbol: Symbol, loc: Loc) -> ExprId {
        let token = loc.first;
        match self.scopes.get(symbol) {
            Binding::Local(id) => {
                self.record_use(token, DeclRef::Local(id));
                let local = &mut self.module[id];
                local.flags.insert(VarFlags::USED);
                let (ty, kind, value) = (local.ty, local.kind, local.value);
                match kind {
                    LocalKind::Const => self.folded(value, loc),
                    LocalKind::ConstIn => self.push(ExprKind::Local(id), ty, ExprFlags::default(), loc),
                    _ if self.is_sampler(ty) => self.push(ExprKind::Local(id), ty, ExprFlags::default(), loc),
                    _ => self.push(ExprKind::Local(id), ty, ExprFlags::PLACE, loc),
                }
            }
            Binding::Global(id) => {
                self.record_use(token, DeclRef::Global(id));
                let global = &mut self.module[id];
                global.flags.insert(VarFlags::USED);
                let (ty, storage, value) = (global.ty, global.storage, global.value);
                match storage {
                    GlobalStorage::Const => self.folded(value, loc),
                    _ if self.is_sampler(ty) => self.own_sampler(id, ty, loc),
                    GlobalStorage::Private | GlobalStorage::Out => {
                        self.push(ExprKind::Global(id), ty, ExprFlags::PLACE, loc)
                    }
                    GlobalStorage::Uniform if value.is_some() => {
                        // Its value is known, but it is not a constant expression in the language.
                        let expr = self.folded(value, loc);
                        self.module[expr].flags = ExprFlags::default();
                        expr
                    }
                    _ => self.push(ExprKind::Global(id), ty, ExprFlags::default(), loc),
                }
            }
            Binding::Uniform(uniform) => self.uniform(uniform, token, loc),
            Binding::CustomUniform(i) => {
                self.record_use(token, DeclRef::CustomUniform(i));
                let ty = super::env::custom_uniform_type(self.settings.custom_uniforms[usize::from(i)].kind);
                self.push(ExprKind::CustomUniform(i), ty, ExprFlags::default(), loc)
            }
            Binding::DeprecatedTime => {
                if self.is_first_report(symbol) {
                    self.warning(loc, "`iGlobalTime` is the old name of `iTime`");
                    self.hint("write `iTime`");
                }
                self.uniform(hir::Uniform::Time, token, loc)
            }
            Binding::Channel(i) => {
                self.record_use(token, DeclRef::Channel(i));
                self.note_in_common(token, DeclRef::Channel(i));
                let ty = self.channel_type(i);
                self.push(ExprKind::Channel(i), ty, ExprFlags::default(), loc)
            }
            Binding::ChannelStruct(i) => {
                self.record_use(token, DeclRef::ChannelStruct(i));
                let id = self.error_expr(loc);
                self.pending_channels.push((id, i));
                id
            }
            Binding::BuiltinVar(var) => {
                self.record_use(token, DeclRef::BuiltinVar(var));
                self.plain_variable(var, symbol, loc);
                let flags = if var.is_place() { ExprFlags::PLACE } else { ExprFlags::default() };
                self.push(ExprKind::BuiltinVar(var), var.ty(), flags, loc)
            }
            Binding::BuiltinConst(value) => {
                self.record_use(token, DeclRef::BuiltinConst(symbol));
                self.literal(value as u32, TypeId::INT, loc)
            }
            Binding::DepthRange => self.depth_range(symbol, loc),
            Binding::Poison => self.error_expr(loc),
            Binding::None => {
                self.unknown_name(symbol, token);
                self.error_expr(loc)
            }
            binding @ (Binding::Builtin(_) | Binding::Function(_) | Binding::Struct(_) | Binding::Block(_)) => {
                let (name, what) = (self.name(symbol), self.describe_binding(binding));
                self.error(loc, format!("`{name}` is {what}, not a value"));
                match binding {
                    Binding::Struct(_) => self.hint(format!("construct one: `{name}(..)`")),
                    _ => self.hint(format!("call it: `{name}(..)`")),
                }
                self.error_expr(loc)
            }
        }
    }

    /// Returns a use of a `const` variable: its value, whose words are shared by all uses.
    fn folded(&mut self, value: Option<hir::ConstId>, loc: Loc) -> ExprId {
        let Some(id) = value else { return self.error_expr(loc) };
        let hir::Const { ty, words } = self.module[id];
        let kind = match &self.module[words] {
            &[bits] if self.vector_shape(ty).is_some() => ExprKind::Literal(bits),
            _ => ExprKind::Const(id),
        };
        self.push(kind, ty, ExprFlags::CONSTANT, loc)
    }

    pub(super) fn uniform(&mut self, uniform: hir::Uniform, token: TokenId, loc: Loc) -> ExprId {
        if uniform != hir::Uniform::ChannelLoaded {
            self.record_use(token, DeclRef::Uniform(uniform));
            self.note_in_common(token, DeclRef::Uniform(uniform));
        }
        let ty = self.uniform_type(uniform, loc);
        self.push(ExprKind::Uniform(uniform), ty, ExprFlags::default(), loc)
    }

    /// Returns the type of a Shadertoy uniform that is named at `loc`.
    pub(super) fn uniform_type(&mut self, uniform: hir::Uniform, loc: Loc) -> TypeId {
        match uniform {
            hir::Uniform::ChannelTime => self.array_type(TypeId::FLOAT, 4, loc),
            hir::Uniform::ChannelResolution => self.array_type(TypeId::VEC3, 4, loc),
            hir::Uniform::ChannelLoaded => self.array_type(TypeId::INT, 4, loc),
            _ => uniform.ty(&mut self.module.types),
        }
    }

    /// Returns `gl_DepthRange`, whose range is always 0 to 1 here.
    fn depth_range(&mut self, symbol: Symbol, loc: Loc) -> ExprId {
        if self.depth_range.is_none() {
            let here = |symbol| ast::Ident { symbol, token: loc.first };
            // A member that the text never names cannot be accessed either; the struct's own name is used instead.
            let members = ["near", "far", "diff"].map(|name| hir::StructMember {
                name: here(self.names.find(name).unwrap_or(symbol)),
                ty: TypeId::FLOAT,
            });
            let ty = self.add_struct(Some(here(symbol)), &members, loc, None);
            let words = [0.0f32, 1.0, 1.0].map(f32::to_bits);
            self.depth_range = Some(self.module.constant(ty, &words));
        }
        self.folded(self.depth_range, loc)
    }

    #[cold]
    fn report_pending_channels(&mut self) {
        for (id, i) in std::mem::take(&mut self.pending_channels) {
            let loc = self.loc(id);
            self.error(loc, format!("`iCh{i}` is a struct and cannot be used as a value"));
            self.hint(format!("write `iCh{i}.sampler`, `iCh{i}.size`, `iCh{i}.time` or `iCh{i}.loaded`"));
        }
    }

    // --------------------------------------------------------------------------------------------------- small kinds

    fn ternary(&mut self, cond: ast::ExprId, then: ast::ExprId, otherwise: ast::ExprId, loc: Loc) -> ExprId {
        self.promote(then, otherwise, false);
        let (c, t, o) = (self.lowered_expr(cond), self.lowered_expr(then), self.lowered_expr(otherwise));
        let (tt, ot) = (self.ty(t), self.ty(o));
        if !self.expect_bool(c, cond, "the condition of `?:`") || tt == TypeId::ERROR || ot == TypeId::ERROR {
            // The type may still be known, so that the surrounding expression can be checked.
            let id = self.error_expr(loc);
            if tt == ot {
                self.module[id].ty = tt;
            }
            return id;
        }
        if tt != ot {
            let (a, b) = (self.type_name(tt), self.type_name(ot));
            let at = self.loc(t).to(self.loc(o));
            self.error(at, format!("both branches of `?:` must have the same type, not `{a}` and `{b}`"));
            self.conversion_hint((t, then), (o, otherwise));
            return self.error_expr(loc);
        }
        let facts = self.facts(tt);
        if tt == TypeId::VOID || facts.arrays || facts.opaque {
            let name = self.type_name(tt);
            self.error(loc, format!("`?:` cannot choose between values of type `{name}`"));
            match self.is_sampler(tt) {
                true => self.hint("choose between the colours: `c ? texture(iChannel0, uv) : texture(iChannel1, uv)`"),
                false => self.hint("use if and else"),
            }
            return self.error_expr(loc);
        }
        if self.struct_of(tt).is_some() {
            self.warning(loc, "Shadertoy refuses `?:` between structs, though the language allows it");
            self.hint("use if and else");
        }
        if self.is_constant(c) && self.is_constant(t) && self.is_constant(o) {
            let chosen = if self.words(c) == Some(&[1]) { t } else { o };
            let hir::Expr { kind, ty, .. } = self.module[chosen];
            return self.push(kind, ty, ExprFlags::CONSTANT, loc);
        }
        let flags = self.inherited(&[c, t, o]);
        self.push(ExprKind::Ternary { cond: c, then: t, otherwise: o }, tt, flags, loc)
    }

    /// Checks a comma operator, which is never a constant expression (section 12.43), even of constants.
    fn comma(&mut self, lhs: ExprId, rhs: ExprId, loc: Loc) -> ExprId {
        let ty = self.ty(rhs);
        for side in [lhs, rhs] {
            let facts = self.facts(self.ty(side));
            if self.ty(side) == TypeId::VOID || facts.arrays {
                let (name, at) = (self.type_name(self.ty(side)), self.loc(side));
                self.error(at, format!("the comma operator takes no value of type `{name}`"));
                self.hint("write two statements, with `;` between them");
                return self.error_expr(loc);
            }
        }
        let flags = self.inherited(&[lhs, rhs]);
        self.push(ExprKind::Comma { lhs, rhs }, ty, flags, loc)
    }

    // --------------------------------------------------------------------------------------------------------- places

    /// Returns the variable, call or constant at the root of a chain of members, components and indices.
    pub(super) fn root_of(&self, expr: ExprId) -> ExprId {
        let mut at = expr;
        loop {
            match self.module[at].kind {
                ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } | ExprKind::Index { base, .. } => {
                    at = base
                }
                _ => return at,
            }
        }
    }

    /// Sets a flag on the variable at the root of a chain, if there is one.
    pub(super) fn flag_root(&mut self, expr: ExprId, flag: VarFlags) {
        match self.module[self.root_of(expr)].kind {
            ExprKind::Local(id) => self.module[id].flags.insert(flag),
            ExprKind::Global(id) => self.module[id].flags.insert(flag),
            _ => {}
        }
    }

    /// Returns whether `expr` may be written to; otherwise reports why not. `doing` describes the attempt: `assigned
    /// to`.
    pub(super) fn place(&mut self, expr: ExprId, doing: &str) -> bool {
        if self.ty(expr) == TypeId::ERROR {
            return false;
        }
        if self.module[expr].flags.contains(ExprFlags::PLACE) {
            self.flag_root(expr, VarFlags::WRITTEN);
            return true;
        }
        self.not_a_place(expr, doing);
        false
    }

    #[cold]
    fn not_a_place(&mut self, expr: ExprId, doing: &str) {
        let loc = self.loc(expr);
        let mut at = expr;
        loop {
            match self.module[at].kind {
                ExprKind::Swizzle { base, swizzle } => {
                    if swizzle.repeats() && self.module[base].flags.contains(ExprFlags::PLACE) {
                        self.error(loc, format!("`{swizzle:?}` has a component twice and cannot be {doing}"));
                        return;
                    }
                    at = base;
                }
                ExprKind::Member { base, .. } | ExprKind::Index { base, .. } => at = base,
                // Already reported.
                ExprKind::Error => return,
                _ => break,
            }
        }
        let Some(name) = self.named_root(expr) else {
            let what = match self.module[at].kind {
                ExprKind::Literal(_) | ExprKind::Const(_) => "a constant",
                ExprKind::Call { .. } | ExprKind::Builtin { .. } => "the result of a call",
                ExprKind::Local(_) | ExprKind::Global(_) | ExprKind::Uniform(_) | ExprKind::CustomUniform(_) => {
                    "a copy made by a constructor"
                }
                _ => "the result of an expression",
            };
            self.error(loc, format!("{what} cannot be {doing}: it is not a variable"));
            if doing.contains("out`") {
                self.hint("pass a variable: the function writes its result there");
            }
            return;
        };
        let text = self.name(name);
        let binding = self.scopes.get(name);
        let what = match binding {
            Binding::Uniform(_) | Binding::CustomUniform(_) | Binding::DeprecatedTime | Binding::DepthRange => {
                "a uniform"
            }
            Binding::Channel(_) => "a sampler",
            Binding::BuiltinVar(_) => "an input",
            Binding::Local(id) if self.is_sampler(self.module[id].ty) => "a sampler",
            Binding::Global(id) => match self.module[id].storage {
                GlobalStorage::Uniform => "a uniform",
                GlobalStorage::In => "an input",
                _ => "`const`",
            },
            Binding::BuiltinConst(_) => "a constant",
            _ => "`const`",
        };
        self.error(loc, format!("`{text}` is {what} and cannot be {doing}"));
        if let Some(declared) = self.declared_at(binding) {
            self.label(declared, "declared here");
        }
        if matches!(what, "a uniform" | "an input") {
            self.hint("copy it to a variable and change that");
        }
    }

    /// Returns the name at the root of an expression written as `name`, `name.member`, `name[index]` and so on.
    fn named_root(&self, expr: ExprId) -> Option<Symbol> {
        // A constructor without a node shares that of its argument: the one written last is used.
        if self.is_full() {
            return None;
        }
        let mut at = self.lowered.iter().rposition(|done| *done == Some(expr))?;
        loop {
            match self.ast.exprs[at].kind {
                A::Name(symbol) => return Some(symbol),
                A::Member { base, .. } | A::Index { base, .. } => at = base.index(),
                _ => return None,
            }
        }
    }

    /// Returns whether an error was reported in the full expression checked last, so that follow-up errors are not
    /// needed.
    #[cold]
    pub(super) fn is_broken(&self) -> bool {
        self.is_full() || self.module.exprs[self.full_expr..].iter().any(|expr| matches!(expr.kind, ExprKind::Error))
    }

    /// Reports a use of a value of type `void`.
    pub(super) fn is_void(&mut self, expr: ExprId) -> bool {
        if self.module.types.get(self.ty(expr)) != Type::Void {
            return false;
        }
        let loc = self.loc(expr);
        self.error(loc, "this function returns nothing (`void`), so it has no value to use");
        self.hint("write the call as a separate statement");
        true
    }
}
