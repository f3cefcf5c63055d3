//! Functions (section 6.1): prototypes, definitions, overloads, parameters.

use super::{
    checker::Checker,
    env::{self, Env},
    facts::FuncFacts,
    qualifiers::DeclContext,
    scope::{self, Binding},
};
use crate::{
    ast::{self, FunctionDeclId, Ident, List, Loc, Precision, StmtKind, Symbol, TokenId, TypeSpecKind},
    hir::{Builtin, FuncId, Function, Local, LocalKind, TypeId, VarFlags},
};
use eddy_diag::{Edit, Fix};

/// A parameter as declared: name, type, direction, precision.
pub(super) type ParamSign = (Option<Ident>, TypeId, LocalKind, Option<Precision>);

pub(super) struct FunctionSign<'s> {
    pub symbol: Symbol,
    pub token: TokenId,
    pub result: TypeId,
    pub params: &'s [ParamSign],
}

impl Checker<'_> {
    /// Adds a function; binds its name, or appends it to the overloads of that name.
    pub(super) fn add_function(&mut self, sign: FunctionSign<'_>, header: Loc, loc: Loc) -> FuncId {
        let id = self.add_unnamed_function(&sign, header, loc);
        match self.scopes.get_innermost(sign.symbol) {
            Some(Binding::Function(first)) => {
                let last = std::mem::replace(&mut self.funcs[first.index()].last, id);
                if last == first {
                    self.overloads.insert((first, self.param_types(first)), first);
                }
                self.overloads.insert((first, self.param_types(id)), id);
                self.funcs[last.index()].next = Some(id);
            }
            _ => self.scopes.declare(sign.symbol, Binding::Function(id)),
        }
        id
    }

    /// Adds a function that nothing can call, because its name may not be declared.
    fn add_unnamed_function(&mut self, sign: &FunctionSign<'_>, header: Loc, loc: Loc) -> FuncId {
        let start = self.add_params(sign.params);
        self.module.functions.push(Function {
            name: Ident { symbol: sign.symbol, token: sign.token },
            declared_at: Vec::new(),
            result: sign.result,
            locals: start..start + sign.params.len() as u32,
            param_count: sign.params.len() as u32,
            exprs: 0..0,
            body: None,
            calls: Vec::new(),
            used: false,
            header,
            loc,
        });
        let id = FuncId::new(self.funcs.len());
        self.funcs.push(FuncFacts { next: None, last: id, first_call: None, called_by: 0 });
        id
    }

    fn param_types(&self, id: FuncId) -> Vec<TypeId> {
        self.module.params(id).iter().map(|p| p.ty).collect()
    }

    /// Returns the overload that takes these types, among those with the first one's name.
    pub(super) fn overload(&self, first: FuncId, types: impl Iterator<Item = TypeId> + Clone) -> Option<FuncId> {
        if self.funcs[first.index()].next.is_none() {
            let params = self.module.params(first).iter().map(|p| p.ty);
            return params.eq(types).then_some(first);
        }
        self.overloads.get(&(first, types.collect())).copied()
    }

    fn add_params(&mut self, params: &[ParamSign]) -> u32 {
        let start = self.module.locals.len() as u32;
        self.module.locals.extend(params.iter().map(|&(name, ty, kind, precision)| Local {
            name,
            ty,
            kind,
            precision,
            value: None,
            flags: VarFlags::default(),
        }));
        start
    }

    /// Returns the location of the first declaration of a function, unless the header declares it.
    pub(super) fn function_at(&self, id: FuncId) -> Option<Loc> {
        self.module[id].declared_at.first().map(|&token| token.into())
    }

    pub(super) fn function_declaration(&mut self, id: FunctionDeclId, loc: Loc) {
        let decl = self.ast[id];
        let result = self.result_type(&decl);
        let params = self.param_signs(&decl);
        let name = decl.name;
        let text = self.name(name.symbol);
        let sign = FunctionSign { symbol: name.symbol, token: name.token, result, params: &params };
        let builtin = Builtin::of_dialect(name.symbol, self.settings.dialect);
        let replaces = self.settings.dialect.replaces_builtins();
        let func = if builtin.is_some_and(|builtin| !builtin.may_be_overloaded) && !replaces {
            self.error(name, format!("`{text}` is a built-in function and cannot be declared again"));
            self.hint(format!("choose another name, `my_{text}` for instance, or remove this to use the built-in"));
            self.add_unnamed_function(&sign, decl.header, loc)
        } else if text == "main" && !self.env.has_main() && self.env != Env::Common {
            let wanted = match self.env {
                Env::Pass(kind) => env::entry(kind).name,
                _ => "mainImage",
            };
            self.error(name, format!("the entry point of this pass is `{wanted}`, not `main`"));
            if let Env::Pass(kind) = self.env {
                let entry = env::entry(kind);
                let is_there = self.header_entry.is_some_and(|id| self.module[id].body.is_some());
                self.hint(match is_there {
                    true => format!("remove it: `{}` is called without it", entry.name),
                    false => format!("write `{}`", entry.usage),
                });
                // `main` is taken for the entry point that draws.
                if !is_there && kind.draws_pixels() && decl.body.is_some() {
                    self.fix_main(&decl);
                    let at = self.diagnostics.len() - 1;
                    let func = self.add_unnamed_function(&sign, decl.header, loc);
                    self.foreign_main = Some((func, at));
                    func
                } else {
                    self.add_unnamed_function(&sign, decl.header, loc)
                }
            } else {
                self.add_unnamed_function(&sign, decl.header, loc)
            }
        } else {
            match self.scopes.get_innermost(name.symbol) {
                None | Some(Binding::Poison) => self.add_function(sign, decl.header, loc),
                Some(Binding::Function(first)) => match self.same_params(first, &params) {
                    Some(known) => self.declared_again(known, &sign, decl, loc),
                    None => self.add_function(sign, decl.header, loc),
                },
                Some(_) => {
                    // Reports that the name is taken; its binding stays.
                    self.declare(name, Binding::Poison);
                    self.add_unnamed_function(&sign, decl.header, loc)
                }
            }
        };
        let is_overload = builtin.is_some_and(|builtin| builtin.may_be_overloaded) && !replaces;
        if is_overload && self.module[func].declared_at.is_empty() {
            self.warning(
                name,
                format!("`{text}` is a built-in function; only Shadertoy's compiler allows overloading it"),
            );
            self.hint("choose another name to be portable");
        }
        self.module[func].declared_at.push(name.token);
        if let Some(body) = decl.body {
            self.define(func, &decl, &params, body, loc);
        }
    }

    /// Offers to turn `main` into the entry point.
    fn fix_main(&mut self, decl: &ast::FunctionDecl) {
        let Env::Pass(kind) = self.env else { return };
        let header = env::entry(kind).usage.trim_end_matches(" { .. }");
        let fix = self.source_span(decl.header).map(|span| {
            let edit = Edit { span, text: header.to_owned() };
            Fix::new(format!("Make it `{}`", env::entry(kind).name), vec![edit])
        });
        self.fix(fix);
    }

    fn result_type(&mut self, decl: &ast::FunctionDecl) -> TypeId {
        let base = self.base_type(decl.result);
        let spec = self.ast[decl.result];
        let quals = self.qualifiers(decl.qualifiers, DeclContext::Result);
        self.check_precision(&quals, base, spec.loc);
        let ty = self.complete_type(base, spec.dims, ast::List::EMPTY, "an array that is returned");
        if self.facts(ty).opaque {
            let name = self.type_name(ty);
            self.error(
                spec.loc,
                format!("a function cannot return a `{name}`: samplers are only passed as parameters"),
            );
            return TypeId::ERROR;
        }
        ty
    }

    fn param_signs(&mut self, decl: &ast::FunctionDecl) -> Vec<ParamSign> {
        let ast = self.ast;
        let mut signs = Vec::with_capacity(decl.params.len());
        for param in &ast[decl.params] {
            let spec = ast[param.ty];
            if let TypeSpecKind::Struct(def) = spec.kind {
                self.error(ast[def].loc, "a struct cannot be defined in a parameter list");
                self.hint("define it before the function and use its name here");
            }
            let base = self.base_type(param.ty);
            let quals = self.qualifiers(param.qualifiers, DeclContext::Param);
            let sizes = self.sizes(spec.dims, param.dims);
            let element = if base == TypeId::VOID && !sizes.is_empty() { TypeId::ERROR } else { base };
            let mut ty = self.sized_type(element, &sizes, TypeId::ERROR).unwrap_or_else(|at| {
                self.error(at, "an array parameter needs a size between the brackets");
                TypeId::ERROR
            });
            if base == TypeId::VOID {
                self.error(spec.loc, "a parameter cannot be of type `void`");
                ty = TypeId::ERROR;
            }
            self.check_precision(&quals, base, spec.loc);
            let kind = quals.param_kind();
            if kind.copies_out() && self.facts(ty).opaque {
                self.error(param.loc, "a sampler can only be passed `in`");
                ty = TypeId::ERROR;
            }
            if self.facts(ty).opaque && !self.is_sampler(ty) {
                let name = self.type_name(ty);
                self.error(param.loc, format!("a `{name}` has samplers and cannot be passed to a function here"));
                self.hint("pass the samplers as separate parameters");
                ty = TypeId::ERROR;
            }
            signs.push((param.name, ty, kind, quals.precision_of(self, base)));
        }
        signs
    }

    /// Returns the overload with these parameter types.
    fn same_params(&self, first: FuncId, params: &[ParamSign]) -> Option<FuncId> {
        self.overload(first, params.iter().map(|param| param.1))
    }

    /// Checks a prototype or definition of a function that was declared before.
    fn declared_again(&mut self, known: FuncId, sign: &FunctionSign<'_>, decl: ast::FunctionDecl, loc: Loc) -> FuncId {
        let name = self.name(sign.symbol);
        let first = self.function_at(known);
        let is_entry = self.entry_symbol == Some(sign.symbol) && self.is_header_entry(known);
        let usage = match self.env {
            Env::Pass(kind) if is_entry => Some(env::entry(kind).usage),
            _ => None,
        };
        if self.module[known].result != sign.result {
            if sign.result != TypeId::ERROR && self.module[known].result != TypeId::ERROR {
                let (was, is) = (self.type_name(self.module[known].result), self.type_name(sign.result));
                self.error(decl.header, format!("`{name}` returns `{is}` here, but was declared to return `{was}`"));
                match usage {
                    Some(usage) => self.hint(format!("{} declares it as `{usage}`", self.settings.dialect.header())),
                    None => self.hint("overloads must differ in their parameters, not only in what they return"),
                }
                if let Some(first) = first {
                    self.label(first, "declared here");
                }
            }
            return self.add_unnamed_function(sign, decl.header, loc);
        }
        let differs = self.module.params(known).iter().zip(sign.params).position(|(a, b)| a.kind != b.2);
        if let Some(at) = differs {
            let param = self.ast[decl.params][at];
            self.error(param.loc, format!("`{name}` was declared with another qualifier (in, out, inout, const) here"));
            match usage {
                Some(usage) => self.hint(format!("{} declares it as `{usage}`", self.settings.dialect.header())),
                None => self.hint("prototype and definition must agree"),
            }
            if let Some(first) = first {
                self.label(first, "declared here");
            }
            return self.add_unnamed_function(sign, decl.header, loc);
        }
        if decl.body.is_some() && self.module[known].body.is_some() {
            self.error(decl.name, format!("`{name}` with these parameters already has a body"));
            self.label(self.module[known].name, "the first definition");
            self.hint("remove one of the two, or rename it");
            return self.add_unnamed_function(sign, decl.header, loc);
        }
        known
    }

    /// Returns whether a function is the entry point that Shadertoy's header declares.
    pub(super) fn is_header_entry(&self, id: FuncId) -> bool {
        self.header_entry == Some(id)
    }

    fn define(&mut self, func: FuncId, decl: &ast::FunctionDecl, params: &[ParamSign], body: ast::StmtId, loc: Loc) {
        // The body's locals follow the parameters, so a definition after a prototype has its own parameters.
        let start = self.add_params(params);
        let function = &mut self.module[func];
        function.name = decl.name;
        function.header = decl.header;
        function.loc = loc;
        function.locals = start..start + params.len() as u32;
        // Marks the function as defined before its body is checked, so that a definition inside itself is an error.
        function.body = Some(List::EMPTY);
        let result = function.result;
        let first_expr = self.module.exprs.len() as u32;
        debug_assert_eq!(self.scopes.depth(), scope::FILE);
        self.scopes.push();
        self.func = Some(func);
        self.returns = false;
        for (i, param) in params.iter().enumerate() {
            if let Some(name) = param.0 {
                self.declare(name, Binding::Local(crate::hir::LocalId::new(start as usize + i)));
            }
        }
        let list = match self.ast[body].kind {
            StmtKind::Block(stmts) => self.statements(stmts),
            _ => List::EMPTY,
        };
        self.pop_scope();
        self.func = None;
        let end = self.module.locals.len() as u32;
        let last_expr = self.module.exprs.len() as u32;
        let function = &mut self.module[func];
        function.exprs = first_expr..last_expr;
        function.body = Some(list);
        function.locals.end = end;
        if result != TypeId::VOID && result != TypeId::ERROR && !self.returns && !self.broken_tree {
            let (name, ty) = (self.name(decl.name.symbol), self.type_name(result));
            self.error(decl.name, format!("`{name}` never returns a value, but is declared to return `{ty}`"));
            self.hint("add a `return ..;`, or declare it `void`");
        }
    }
}
