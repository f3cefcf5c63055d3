//! Calls: of user functions, built-ins, and struct constructors; and the diagnostics if no overload matches.

use super::{checker::Checker, env, fault, scope::Binding, words::ScalarWords};
use crate::{
    ast::{self, BasicType, List, Loc, Symbol},
    builtins::{Arg, Operation, Overload},
    hir::{self, Builtin, DeclRef, ExprFlags, ExprId, ExprKind, FuncId, LocalKind, Scalar, Type, TypeId},
    parse::foreign_type,
};

/// The number of arguments that no built-in exceeds.
const MAX_ARGS: usize = 8;

impl Checker<'_> {
    pub(super) fn call(&mut self, name: Symbol, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        match self.scopes.get(name) {
            Binding::Builtin(builtin) => self.builtin_call(builtin, args, loc),
            Binding::Function(first) => self.user_call(first, args, loc),
            Binding::Struct(id) => {
                self.record_use(loc.first, DeclRef::Struct(id));
                self.construct_struct(id, args, loc)
            }
            Binding::Poison => self.error_expr(loc),
            Binding::None => {
                if let Some(builtin) = self.earlier_texture_function(name) {
                    return self.builtin_call(builtin, args, loc);
                }
                if let Some(ty) = foreign_type(self.name(name)) {
                    return self.foreign_constructor(name, ty, args, loc);
                }
                self.unknown_function(name, args, loc);
                self.error_expr(loc)
            }
            hidden => {
                let text = self.name(name);
                let what = self.describe_binding(hidden);
                self.error(loc.first, format!("`{text}` is {what} here and cannot be called"));
                if let Some(at) = self.declared_at(hidden) {
                    self.label(at, "this declaration hides any function of the name");
                }
                self.hint("give one of the two another name");
                self.error_expr(loc)
            }
        }
    }

    /// Returns the function that replaces a texture function of an earlier version of GLSL (1.20, section 8.7) or of its
    /// extensions; GLSL 1.30 deprecates these names (section 1.5.1).
    fn earlier_texture_function(&self, name: Symbol) -> Option<Builtin> {
        if !self.settings.dialect.is_any() {
            return None;
        }
        let text = self.name(name);
        let rest =
            ["texture1D", "texture2D", "texture3D", "textureCube"].iter().find_map(|of| text.strip_prefix(of))?;
        let rest = rest.strip_suffix("EXT").or_else(|| rest.strip_suffix("ARB")).unwrap_or(rest);
        let now = match rest {
            "" => "texture",
            "Proj" => "textureProj",
            "Lod" => "textureLod",
            "ProjLod" => "textureProjLod",
            "Grad" => "textureGrad",
            "ProjGrad" => "textureProjGrad",
            _ => return None,
        };
        Builtin::all().find(|builtin| builtin.name == now)
    }

    /// Reports `float3(..)` and the like once, and checks it as the type that was meant.
    #[cold]
    fn foreign_constructor(&mut self, name: Symbol, ty: BasicType, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        let text = self.name(name);
        if self.is_first_report(name) {
            self.error(loc.first, format!("GLSL has no type `{text}`"));
            self.hint(format!("write `{}`", ty.name()));
        }
        self.construct_type(TypeId::basic(ty), args, loc)
    }

    // ------------------------------------------------------------------------------------------------ users' functions

    fn user_call(&mut self, first: FuncId, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        let ast = self.ast;
        let types =
            ast[args].iter().map(|&arg| self.lowered[arg.index()].map_or(TypeId::ERROR, |arg| self.module[arg].ty));
        if types.clone().all(|ty| ty != TypeId::ERROR)
            && let Some(id) = self.overload(first, types)
        {
            return self.resolved_call(id, args, loc);
        }
        // A built-in overload that takes the arguments unconverted has priority over user functions that need
        // conversions.
        let builtin = Builtin::of_dialect(self.module[first].name.symbol, self.settings.dialect);
        let is_exact = builtin.is_some_and(|builtin| {
            let given: Vec<TypeId> = ast[args].iter().map(|&arg| self.ty(self.lowered_expr(arg))).collect();
            self.builtin_result(builtin, &given).is_some()
        });
        if !is_exact && let Some(id) = self.converting_overload(first, args) {
            for (i, &arg) in ast[args].iter().enumerate() {
                let want = self.module.params(id)[i].ty;
                self.implicit(arg, want);
            }
            return self.resolved_call(id, args, loc);
        }
        // Overloads by the user do not hide those of the built-in.
        if let Some(builtin) = builtin {
            return self.builtin_call(builtin, args, loc);
        }
        let broken = ast[args].iter().any(|&arg| self.ty(self.lowered_expr(arg)) == TypeId::ERROR);
        if !broken && !self.is_full() {
            self.no_user_overload(first, args, loc);
        }
        // If there is only one candidate, the result's type is known anyway.
        if self.funcs[first.index()].next.is_some() {
            return self.error_expr(loc);
        }
        self.record_use(loc.first, DeclRef::Func(first));
        self.error_expr_of(self.module[first].result, loc)
    }

    /// Returns the overload that the arguments can be converted to with the fewest implicit conversions (GLSL 4.30,
    /// section 6.1); `out` arguments are not converted.
    fn converting_overload(&self, first: FuncId, args: List<ast::ExprId>) -> Option<FuncId> {
        if !self.settings.dialect.converts() {
            return None;
        }
        let given: Vec<TypeId> = self.ast[args].iter().map(|&arg| self.ty(self.lowered_expr(arg))).collect();
        let conversions = |id: FuncId| {
            let params = self.module.params(id);
            let fits = |(param, &ty): (&hir::Local, &TypeId)| match param.kind.copies_out() {
                true => param.ty == ty,
                false => self.converts_to(ty, param.ty),
            };
            let is_one = params.len() == given.len() && params.iter().zip(&given).all(fits);
            is_one.then(|| params.iter().zip(&given).filter(|(param, ty)| param.ty != **ty).count())
        };
        let all = std::iter::successors(Some(first), |id| self.funcs[id.index()].next);
        all.filter_map(|id| Some((conversions(id)?, id))).min_by_key(|(count, _)| *count).map(|(_, id)| id)
    }

    fn resolved_call(&mut self, func: FuncId, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        self.record_use(loc.first, DeclRef::Func(func));
        let ast = self.ast;
        let base = self.expr_stack.len();
        let first_param = self.module[func].locals.start as usize;
        let mut legal = true;
        for (i, &arg) in ast[args].iter().enumerate() {
            let id = self.lowered_expr(arg);
            let kind = self.module.locals[first_param + i].kind;
            if kind.copies_out() {
                let doing = if kind == LocalKind::Out { "passed as `out`" } else { "passed as `inout`" };
                legal &= self.place(id, doing);
            }
            self.expr_stack.push(id);
        }
        self.note_call(func, loc);
        let result = self.module[func].result;
        let id = if legal {
            let flags = self.inherited(&self.expr_stack[base..]) | ExprFlags::EFFECTS;
            let args = self.module.list(&self.expr_stack[base..]);
            self.push(ExprKind::Call { func, args }, result, flags, loc)
        } else {
            self.error_expr_of(result, loc)
        };
        self.expr_stack.truncate(base);
        id
    }

    /// Adds a call to the call graph.
    fn note_call(&mut self, callee: FuncId, loc: Loc) {
        let facts = &mut self.funcs[callee.index()];
        facts.first_call.get_or_insert(loc);
        match self.func {
            Some(caller) => {
                let stamp = caller.index() as u32 + 1;
                if facts.called_by != stamp {
                    facts.called_by = stamp;
                    self.module[caller].calls.push(callee);
                }
            }
            None => self.global_calls.push(callee),
        }
    }

    #[cold]
    fn no_user_overload(&mut self, first: FuncId, args: List<ast::ExprId>, loc: Loc) {
        let ast = self.ast;
        let name = self.name(self.module[first].name.symbol);
        let given: Vec<TypeId> = ast[args].iter().map(|&arg| self.ty(self.lowered_expr(arg))).collect();
        if ast[args].iter().any(|&arg| self.is_void(self.lowered_expr(arg))) {
            return;
        }
        if self.funcs[first.index()].next.is_none() {
            let params: Vec<TypeId> = self.module.params(first).iter().map(|p| p.ty).collect();
            if params.len() != given.len() {
                let (needed, given) = (count(params.len(), "argument"), given.len());
                self.error(
                    loc,
                    format!("`{name}` takes {needed}, {given} {} given", if given == 1 { "is" } else { "are" }),
                );
                self.hint(format!("it is declared as `{}`", self.signature(first)));
                if let Some(at) = self.function_at(first) {
                    self.label(at, "declared here");
                }
                return;
            }
            self.wrong_arguments(name, args, &params);
            if let Some(at) = self.function_at(first) {
                self.label(at, format!("declared as `{}`", self.signature(first)));
            }
            return;
        }
        let mut candidates = Vec::new();
        let mut next = Some(first);
        while let Some(id) = next {
            candidates.push(id);
            next = self.funcs[id.index()].next;
        }
        let types = |id: FuncId| self.module.params(id).iter().map(|p| p.ty).collect::<Vec<_>>();
        let meant = self.closest(&given, candidates.iter().map(|&id| types(id)));
        let shown = self.type_list(&given);
        self.error(loc, format!("no overload of `{name}` takes ({shown})"));
        for (i, want) in meant.into_iter().flatten().enumerate() {
            let written = ast[args][i];
            if want != given[i]
                && let Some(fix) = self.conversion_fix(self.lowered_expr(written), written, want)
            {
                self.suggest_conversion(&fix, written);
            }
        }
        for id in candidates.into_iter().take(6) {
            self.hint(format!("candidate: `{}`", self.signature(id)));
        }
    }

    /// Reports all arguments of wrong types in one message.
    fn wrong_arguments(&mut self, name: &str, args: List<ast::ExprId>, want: &[TypeId]) {
        let ast = self.ast;
        let pairs = ast[args].iter().zip(want).map(|(&written, &want)| (self.lowered_expr(written), written, want));
        let wrong: Vec<_> =
            pairs.clone().filter(|&(value, _, want)| self.ty(value) != want && want != TypeId::ERROR).collect();
        let Some(&(first, _, ty)) = wrong.first() else { return };
        let at = pairs.clone().position(|(value, ..)| value == first).map_or(0, |i| i + 1);
        let message = format!("argument {at} of `{name}` must be {}, not {{}}", self.with_article(ty));
        self.wrong_types(&wrong, &message);
    }

    /// Returns the signature of a function, such as `float f(vec3, inout int)`.
    pub(super) fn signature(&self, id: FuncId) -> String {
        let params: Vec<String> = self
            .module
            .params(id)
            .iter()
            .map(|p| {
                let direction = match p.kind {
                    LocalKind::Out => "out ",
                    LocalKind::Inout => "inout ",
                    _ => "",
                };
                let name = p.name.map(|n| format!(" {}", self.name(n.symbol))).unwrap_or_default();
                format!("{direction}{}{name}", self.type_name(p.ty))
            })
            .collect();
        let func = &self.module[id];
        format!("{} {}({})", self.type_name(func.result), self.name(func.name.symbol), params.join(", "))
    }

    fn type_list(&self, types: &[TypeId]) -> String {
        types.iter().map(|&ty| self.type_name(ty)).collect::<Vec<_>>().join(", ")
    }

    // ------------------------------------------------------------------------------------------------------ built-ins

    fn builtin_call(&mut self, builtin: Builtin, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        self.record_use(loc.first, DeclRef::Builtin(builtin));
        let is_derivative = matches!(builtin.operation, Operation::Derivative(..) | Operation::QueryLod);
        if is_derivative && self.env.is_vertex() && !self.is_shared(loc) {
            self.error(
                loc,
                format!("`{}` works only in a fragment stage: a vertex stage has no neighbouring pixels", builtin.name),
            );
            self.hint("move it to the fragment stage");
        }
        let ast = self.ast;
        let base = self.expr_stack.len();
        let mut types = [TypeId::ERROR; MAX_ARGS];
        let mut known = true;
        for (i, &arg) in ast[args].iter().enumerate() {
            let id = self.lowered_expr(arg);
            let ty = self.ty(id);
            known &= ty != TypeId::ERROR;
            if let Some(slot) = types.get_mut(i) {
                *slot = ty;
            }
            self.expr_stack.push(id);
        }
        let given = &types[..args.len().min(MAX_ARGS)];
        let mut result = self.builtin_result(builtin, given);
        if result.is_none()
            && self.settings.dialect.converts()
            && let Some((converted, of)) = self.converting_builtin(builtin, given)
        {
            for (i, (&arg, &want)) in ast[args].iter().zip(&converted).enumerate() {
                self.expr_stack[base + i] = self.implicit(arg, want);
            }
            types[..converted.len()].copy_from_slice(&converted);
            result = Some(of);
        }
        let given = &types[..args.len().min(MAX_ARGS)];
        let id = match result {
            Some(result) if args.len() <= MAX_ARGS => {
                self.plain_texture_call(builtin, &types[..args.len()], loc);
                self.resolved_builtin(builtin, result, args, base, loc)
            }
            _ if !known => {
                // Most results have the type of the first argument, but a wrong guess would cause spurious errors.
                self.error_expr(loc)
            }
            _ => {
                let given = given.to_vec();
                self.no_builtin_overload(builtin, &given, args, loc)
            }
        };
        self.expr_stack.truncate(base);
        id
    }

    fn resolved_builtin(
        &mut self,
        builtin: Builtin,
        result: TypeId,
        args: List<ast::ExprId>,
        base: usize,
        loc: Loc,
    ) -> ExprId {
        if self.expr_stack[base..].iter().all(|&id| self.is_constant(id))
            && !self.expr_stack.is_empty()
            && let Some(folded) = self.fold_builtin(builtin, result, base, loc)
        {
            return folded;
        }
        let mut flags = self.inherited(&self.expr_stack[base..]);
        if builtin.has_effect() {
            flags |= ExprFlags::EFFECTS;
        }
        for &at in builtin.writes {
            if !self.place(self.expr_stack[base + at], "passed as `out`") {
                return self.error_expr_of(result, loc);
            }
        }
        if let Some(at) = builtin.offset_argument()
            && !self.check_offset(builtin, self.expr_stack[base + at])
        {
            return self.error_expr_of(result, loc);
        }
        if let Some(at) = builtin.component_argument(args.len())
            && !self.check_component(builtin, self.expr_stack[base + at])
        {
            return self.error_expr_of(result, loc);
        }
        debug_assert_eq!(args.len(), self.expr_stack.len() - base);
        let args = self.module.list(&self.expr_stack[base..]);
        self.push(ExprKind::Builtin { builtin, args }, result, flags, loc)
    }

    /// Returns the value of a built-in whose arguments, on the stack above `base`, are all constants; `None` if it
    /// cannot be folded.
    fn fold_builtin(&mut self, builtin: Builtin, result: TypeId, base: usize, loc: Loc) -> Option<ExprId> {
        let types = &self.module.types;
        let given = &self.expr_stack[base..];
        let mut args = [Arg { words: &[], scalar: Scalar::Float, columns: 1 }; 4];
        for (arg, &id) in args.get_mut(..given.len())?.iter_mut().zip(given) {
            let ty = self.module[id].ty;
            let columns = if let Type::Matrix { columns, .. } = types.get(ty) { columns.into() } else { 1 };
            *arg = Arg { words: self.words(id)?, scalar: types.scalar(ty)?, columns };
        }
        let args = &args[..given.len()];
        let mut words = ScalarWords::zeros(types.components(result)? as usize);
        if !builtin.fold(args, words.as_mut_slice()) {
            return None;
        }
        let gap = builtin.gap(args);
        let (mut is_nan, mut is_infinite) = (false, false);
        if types.scalar(result) == Some(Scalar::Float) && !builtin.reads_bits() {
            let floats = args.iter().filter(|arg| arg.scalar == Scalar::Float);
            (is_nan, is_infinite) = fault::introduces_nan_or_infinity(floats.map(|arg| arg.words), words.as_slice());
        }
        let id = self.constant(result, words.as_slice(), loc);
        match gap {
            None => self.note_floats(loc, is_nan, is_infinite),
            Some((gap, _)) => {
                self.undefined(loc, gap.what);
                self.warning(loc, format!("`{}` is undefined for this value; 0 is used", builtin.name));
            }
        }
        Some(id)
    }

    /// Checks that an offset is a constant expression in the range of the implementation (section 8.8).
    fn check_offset(&mut self, builtin: Builtin, offset: ExprId) -> bool {
        let loc = self.loc(offset);
        let Some(words) = self.words(offset) else {
            if self.is_broken() {
                return false;
            }
            self.error(loc, format!("the offset of `{}` must be a constant expression", builtin.name));
            self.hint("to move by a varying amount, add it to the coordinate");
            return false;
        };
        let (min, max) = (env::MIN_OFFSET, env::MAX_OFFSET);
        if let Some(&bad) = words.iter().find(|&&bits| !(min..=max).contains(&(bits as i32))) {
            self.error(loc, format!("the offset {} is out of range: {min} to {max} texels", bad as i32));
            return false;
        }
        true
    }

    /// Checks that the component that is gathered is a constant from 0 to 3 (GLSL 4.60, section 8.9.4). A float is the
    /// reference value of a comparison.
    fn check_component(&mut self, builtin: Builtin, component: ExprId) -> bool {
        if self.ty(component) != TypeId::INT {
            return true;
        }
        let loc = self.loc(component);
        let name = builtin.name;
        match self.words(component).map(|words| words[0] as i32) {
            Some(0..=3) => return true,
            Some(other) => {
                self.error(loc, format!("`{name}` has no component {other}: 0 to 3 are x, y, z and w"));
            }
            None if self.is_broken() => {}
            None => {
                self.error(loc, format!("the component of `{name}` must be a constant expression"));
            }
        }
        false
    }

    #[cold]
    fn no_builtin_overload(&mut self, builtin: Builtin, given: &[TypeId], args: List<ast::ExprId>, loc: Loc) -> ExprId {
        let ast = self.ast;
        let name = builtin.name;
        if ast[args].iter().any(|&arg| self.is_void(self.lowered_expr(arg))) {
            return self.error_expr(loc);
        }
        let all = builtin.overloads;
        let counts: Vec<usize> = all.iter().map(|o| o.params.len()).collect();
        if !counts.contains(&args.len()) {
            let (min, max) = (counts.iter().min().copied().unwrap_or(0), counts.iter().max().copied().unwrap_or(0));
            let needed = if min == max { count(min, "argument") } else { format!("{min} to {max} arguments") };
            self.error(loc, format!("`{name}` takes {needed}, {}", count_given(args.len())));
            self.candidates(builtin, given);
            return self.error_expr(loc);
        }
        let size = self.largest(given);
        let wanted = all.iter().filter_map(|overload| overload.params_at(size, given, &self.module.types));
        if let Some(want) = self.closest(given, wanted) {
            self.wrong_arguments(name, args, &want);
            // Only if the first argument is right, the intended overload is certain.
            let result = self.builtin_result(builtin, &want).filter(|_| given[0] == want[0]);
            return self.error_expr_of(result.unwrap_or(TypeId::ERROR), loc);
        }
        let shown = self.type_list(given);
        self.error(loc, format!("no overload of `{name}` takes ({shown})"));
        self.sampler_hint(all, given, ast[args][0]);
        self.candidates(builtin, given);
        self.error_expr(loc)
    }

    /// Returns the number of components of the largest argument.
    fn largest(&self, given: &[TypeId]) -> u8 {
        given.iter().filter_map(|&ty| self.vector_shape(ty)).map(|(_, n)| n).max().unwrap_or(1)
    }

    /// Returns the parameter types nearest to the given arguments, if one list is nearest: converting ints to floats is
    /// preferred to the reverse, and a scalar may become a vector.
    fn closest(&self, given: &[TypeId], overloads: impl Iterator<Item = Vec<TypeId>>) -> Option<Vec<TypeId>> {
        let mut best: Option<(u32, Vec<TypeId>)> = None;
        let mut tie = false;
        for want in overloads.filter(|want| want.len() == given.len()) {
            let Some(cost) =
                want.iter().zip(given).map(|(&want, &have)| self.distance(have, want)).sum::<Option<u32>>()
            else {
                continue;
            };
            // Types that are equal and still do not match are matrices of different shapes.
            match &best {
                _ if cost == 0 => {}
                Some((least, known)) if *least < cost || *known == want => {}
                Some((least, _)) if *least == cost => tie = true,
                _ => {
                    tie = false;
                    best = Some((cost, want));
                }
            }
        }
        best.filter(|_| !tie).map(|(_, want)| want)
    }

    fn distance(&self, have: TypeId, want: TypeId) -> Option<u32> {
        if have == want {
            return Some(0);
        }
        let ((from, n), (to, m)) = (self.vector_shape(have)?, self.vector_shape(want)?);
        match (from, to) {
            _ if from == to && n == 1 => Some(2),
            (Scalar::Int | Scalar::Uint, Scalar::Float | Scalar::Int | Scalar::Uint) if n == m => Some(1),
            _ if n == m && from != Scalar::Bool && to != Scalar::Bool => Some(3),
            _ => None,
        }
    }

    /// Adds a hint if the coordinates would match a sampler of another shape.
    fn sampler_hint(&mut self, all: &[Overload], given: &[TypeId], sampler: ast::ExprId) {
        if given.first().is_none_or(|&ty| !self.is_sampler(ty)) {
            return;
        }
        let fit = |ty: BasicType| {
            let mut with = given.to_vec();
            with[0] = TypeId::basic(ty);
            all.iter().any(|overload| overload.result_for(&with, &self.module.types).is_some())
        };
        let shapes = [BasicType::Sampler2D, BasicType::Sampler3D, BasicType::SamplerCube];
        let fits: Vec<&str> = shapes.into_iter().filter(|&ty| fit(ty)).map(BasicType::name).collect();
        if fits.is_empty() {
            return;
        }
        let has = self.type_name(given[0]);
        let what = match self.ast[sampler].kind {
            ast::ExprKind::Name(symbol) => self.name(symbol),
            _ => "the first argument",
        };
        self.hint(format!("{what} is a `{has}` here; these coordinates are for a `{}`", fits.join("` or `")));
    }

    /// Lists overloads at the size of the arguments, those with the right number of arguments first.
    fn candidates(&mut self, builtin: Builtin, given: &[TypeId]) {
        let size = self.largest(given);
        let sampler = given.first().filter(|&&ty| self.is_sampler(ty)).map(|&ty| self.type_name(ty));
        let mut lines: Vec<(bool, String)> = Vec::new();
        for overload in builtin.overloads {
            let params: Vec<String> = overload.params.iter().map(|&p| overload.shown(p, size)).collect();
            if sampler.as_ref().is_some_and(|sampler| params[0] != *sampler) {
                continue;
            }
            let line = format!("{} {}({})", overload.shown(overload.result, size), builtin.name, params.join(", "));
            let off = overload.params.len() != given.len();
            if !lines.iter().any(|(_, l)| *l == line) {
                lines.push((off, line));
            }
        }
        lines.sort_by_key(|(off, _)| *off);
        for (_, line) in lines.into_iter().take(4) {
            self.hint(format!("candidate: `{line}`"));
        }
    }

    /// Returns the types of the arguments after implicit conversions (GLSL 4.30, section 6.1) for which a built-in has
    /// an overload, and its result: as few arguments as possible are converted, ints to uints or else to floats. Those
    /// that the built-in writes are not converted.
    fn converting_builtin(&self, builtin: Builtin, given: &[TypeId]) -> Option<(Vec<TypeId>, TypeId)> {
        let of = |ty: TypeId, to| self.vector_shape(ty).map(|(_, n)| TypeId::vector(to, n));
        let can = |i: usize, to| {
            of(given[i], to).is_some_and(|want| want != given[i] && self.converts_to(given[i], want))
                && !builtin.writes.contains(&i)
        };
        // Each set has a bit for each argument that is converted.
        let mut sets: Vec<u32> = (1..1u32 << given.len()).collect();
        sets.sort_by_key(|set| set.count_ones());
        let targets = sets.into_iter().flat_map(|set| [(set, Scalar::Uint), (set, Scalar::Float)]);
        let mut possible = targets.filter(|&(set, to)| (0..given.len()).all(|i| set & 1 << i == 0 || can(i, to)));
        possible.find_map(|(set, to)| {
            let ty = |(i, &ty): (usize, &TypeId)| if set & 1 << i == 0 { Some(ty) } else { of(ty, to) };
            let types: Vec<TypeId> = given.iter().enumerate().map(ty).collect::<Option<_>>()?;
            let result = self.builtin_result(builtin, &types)?;
            Some((types, result))
        })
    }

    /// Returns the result type of a built-in for these argument types, if some overload takes them.
    fn builtin_result(&self, builtin: Builtin, args: &[TypeId]) -> Option<TypeId> {
        let is_later = self.settings.dialect.builtins_until() >= 450;
        let later = builtin.later_overloads.iter().filter(|_| is_later);
        let mut all = builtin.overloads.iter().chain(later);
        all.find_map(|overload| overload.result_for(args, &self.module.types))
    }
}

/// Formats `1 is given`, `2 are given`.
pub(super) fn count_given(n: usize) -> String {
    format!("{n} {} given", if n == 1 { "is" } else { "are" })
}

/// Formats `1 argument`, `2 arguments`.
pub(super) fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}
