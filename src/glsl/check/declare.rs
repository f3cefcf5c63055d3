//! Declarations of variables (section 4.3) at file scope and in functions, uniform blocks, and the other kinds of
//! declarations.

use rustc_hash::FxHashSet;

use super::{
    checker::Checker,
    facts::MAX_WORDS,
    qualifiers::{DeclContext, LayoutOf, Qualifiers},
    scope::Binding,
    suggest::shadertoy_input,
};
use crate::{
    ast::{self, DeclKind, Declarator, Field, Ident, List, Loc, Precision, QualifierKind as Q, TypeSpecId},
    hir::{
        ConstId, ExprId, ExprKind, Global, GlobalId, GlobalStorage, Local, LocalId, LocalKind, StmtKind, StructMember,
        TypeId, VarFlags,
    },
};

impl Checker<'_> {
    pub(super) fn global_declaration(&mut self, id: ast::DeclId) {
        let ast::Decl { kind, loc } = self.ast[id];
        match kind {
            DeclKind::Error => {}
            // GLSL 4.60 allows it (section 9, `external_declaration`), and so do drivers in all versions.
            DeclKind::Empty if self.settings.dialect.is_any() => {}
            DeclKind::Empty => {
                self.error(loc, "a `;` without a declaration");
                self.hint("remove it");
            }
            DeclKind::Vars { qualifiers, ty, declarators } => {
                let quals = self.qualifiers(qualifiers, DeclContext::Global);
                let base = self.base_type(ty);
                self.check_precision(&quals, base, self.ast[ty].loc);
                let ast = self.ast;
                for &declarator in &ast[declarators] {
                    self.global_variable(&quals, base, ty, declarator, loc);
                }
            }
            DeclKind::Precision { precision, ty } => self.precision_statement(precision, ty),
            DeclKind::Qualify { qualifiers, names } => self.qualify(qualifiers, names, loc),
            DeclKind::Function(function) => self.function_declaration(function, loc),
            DeclKind::Block { qualifiers, name, fields, instance, dims } => {
                self.block(qualifiers, name, fields, instance, dims, loc);
            }
        }
    }

    pub(super) fn local_declaration(&mut self, id: ast::DeclId) {
        let ast::Decl { kind, loc } = self.ast[id];
        match kind {
            DeclKind::Error | DeclKind::Empty => {}
            DeclKind::Vars { qualifiers, ty, declarators } => {
                let quals = self.qualifiers(qualifiers, DeclContext::Local);
                let base = self.base_type(ty);
                self.check_precision(&quals, base, self.ast[ty].loc);
                let ast = self.ast;
                for &declarator in &ast[declarators] {
                    self.local_variable(&quals, base, ty, declarator, loc);
                }
            }
            DeclKind::Precision { precision, ty } => self.precision_statement(precision, ty),
            // `precise` has no effect.
            DeclKind::Qualify { qualifiers, .. } if self.are_precise(qualifiers) => {}
            DeclKind::Qualify { .. } => {
                self.error(loc, "qualifiers of declared names can only be changed at file scope");
            }
            DeclKind::Function(function) => {
                let name = self.ast[function].name;
                let text = self.name(name.symbol);
                self.error(
                    self.ast[function].header,
                    format!("`{text}`: a function cannot be declared inside another"),
                );
                self.hint("move it to file scope, before this function");
            }
            DeclKind::Block { name, .. } => {
                self.error(name, "a block cannot be declared inside a function");
            }
        }
    }

    /// Returns the type of a variable, with its checked initialiser, which determines the size of `[]`.
    pub(super) fn variable_type(
        &mut self,
        base: TypeId,
        spec: TypeSpecId,
        declarator: Declarator,
    ) -> (TypeId, Option<ExprId>) {
        let spec = self.ast[spec];
        let sizes = self.sizes(spec.dims, declarator.dims);
        let init = declarator.init.map(|init| self.expr(init));
        let name = self.name(declarator.name.symbol);
        if base == TypeId::VOID {
            self.error(spec.loc, format!("the variable `{name}` cannot be of type `void`"));
            return (TypeId::ERROR, init);
        }
        let like = init.map_or(TypeId::VOID, |init| self.ty(init));
        let ty = match self.sized_type(base, &sizes, like) {
            Ok(ty) => ty,
            Err(_) if like == TypeId::ERROR => TypeId::ERROR,
            Err(at) => {
                let element = self.type_name(base);
                let message = "needs a size between the brackets, or an initialiser that is an array";
                self.error(at, format!("`{name}` {message}"));
                self.hint(format!("write `{element} {name}[] = {element}[](..);`"));
                TypeId::ERROR
            }
        };
        (ty, init)
    }

    /// Returns the initialiser if its type matches, converted where the language converts implicitly.
    fn check_init(&mut self, name: Ident, ty: TypeId, init: ExprId, written: ast::ExprId) -> Option<ExprId> {
        let init = if self.ty(init) == ty { init } else { self.implicit(written, ty) };
        if ty == TypeId::ERROR || self.ty(init) == TypeId::ERROR || self.is_void(init) {
            return None;
        }
        let fits = self.expect_type(init, written, ty, |checker| {
            let (ty, name) = (checker.type_name(ty), checker.name(name.symbol));
            format!("cannot initialise the `{ty}` `{name}` with {{}}")
        });
        fits.then_some(init)
    }

    /// Returns the value of a `const` variable; reports errors in its initialiser.
    fn const_value(&mut self, name: Ident, ty: TypeId, init: Option<(ExprId, ast::ExprId)>) -> Option<ConstId> {
        let text = self.name(name.symbol);
        let Some((init, written)) = init else {
            self.error(name, format!("`{text}` is `const` and needs a value"));
            self.hint("initialise it, or remove `const`");
            return None;
        };
        let init = self.check_init(name, ty, init, written)?;
        if !self.is_constant(init) {
            if self.is_broken() {
                return None;
            }
            let loc = self.loc(init);
            self.error(loc, format!("`{text}` is `const`, but its value is not a constant expression"));
            if self.func.is_some() {
                self.hint("remove `const`: it is for values known before the shader runs");
            } else {
                self.hint(
                    "compute it in a function, or remove what varies: uniforms, variables, calls of your own functions",
                );
            }
            return None;
        }
        self.as_const(init)
    }

    /// Returns a folded expression's value as a constant of the module.
    fn as_const(&mut self, init: ExprId) -> Option<ConstId> {
        let expr = self.module[init];
        match expr.kind {
            crate::hir::ExprKind::Const(id) => Some(id),
            crate::hir::ExprKind::Literal(bits) => Some(self.module.constant(expr.ty, &[bits])),
            _ => None,
        }
    }

    // ------------------------------------------------------------------------------------------------------ functions

    fn local_variable(&mut self, quals: &Qualifiers, base: TypeId, spec: TypeSpecId, declarator: Declarator, loc: Loc) {
        let name = declarator.name;
        let (ty, init) = self.variable_type(base, spec, declarator);
        if self.facts(ty).opaque {
            self.error(self.ast[spec].loc, format!("a `{}` cannot be a local variable", self.type_name(ty)));
            self.hint("name the channel where it is sampled, or pass it to a function as a parameter");
            self.declare(name, Binding::Poison);
            return;
        }
        let init = init.zip(declarator.init);
        let precision = quals.precision_of(self, base);
        if quals.constant.is_some() {
            let value = self.const_value(name, ty, init);
            // Without a value it is treated as a variable, so that its uses are not reported as well.
            let kind = if value.is_some() { LocalKind::Const } else { LocalKind::Var };
            self.add_local(name, ty, kind, precision, value);
            return;
        }
        let init = init.and_then(|(init, written)| self.check_init(name, ty, init, written));
        let local = self.add_local(name, ty, LocalKind::Var, precision, None);
        self.add_stmt(StmtKind::Declare { local, init }, loc);
    }

    pub(super) fn add_local(
        &mut self,
        name: Ident,
        ty: TypeId,
        kind: LocalKind,
        precision: Option<Precision>,
        value: Option<ConstId>,
    ) -> LocalId {
        self.module.locals.push(Local { name: Some(name), ty, kind, precision, value, flags: VarFlags::default() });
        let id = LocalId::new(self.module.locals.len() - 1);
        self.declare(name, Binding::Local(id));
        id
    }

    // ----------------------------------------------------------------------------------------------------- file scope

    fn global_variable(
        &mut self,
        quals: &Qualifiers,
        base: TypeId,
        spec: TypeSpecId,
        declarator: Declarator,
        loc: Loc,
    ) {
        let name = declarator.name;
        let text = self.name(name.symbol);
        if self.redeclared_uniform(quals, base, spec, declarator) || self.redeclared_variable(quals, base, declarator) {
            return;
        }
        if quals.storage.is_some() && !self.env.is_main() && self.is_taken(name) {
            return;
        }
        let (ty, init) = self.variable_type(base, spec, declarator);
        if self.is_of_other_stage(name, ty, init) || self.is_of_host(quals, name, ty) {
            return;
        }
        self.check_interface(quals, ty, self.ast[spec].loc);
        let init = init.zip(declarator.init);
        let mut storage = match quals.storage {
            Some((Q::Uniform, _)) => GlobalStorage::Uniform,
            // A vertex shader whose text precedes this one may write it.
            Some((Q::In, _)) if self.env.is_main() => GlobalStorage::Private,
            Some((Q::In, _)) => GlobalStorage::In,
            Some((Q::Out, _)) if self.env.has_main() => GlobalStorage::Out,
            // The pass already has an output: this is an ordinary variable, reported at the end if it is used.
            Some((Q::Out, _)) => GlobalStorage::Private,
            _ if quals.constant.is_some() => GlobalStorage::Const,
            _ => GlobalStorage::Private,
        };
        if self.facts(ty).opaque && storage != GlobalStorage::Uniform {
            self.error(self.ast[spec].loc, format!("the sampler `{text}` must be a uniform or a parameter"));
            self.hint(match self.env.is_plain() {
                true => "write `uniform` before it",
                false => "use iChannel0 to iChannel3",
            });
            self.declare(name, Binding::Poison);
            return;
        }
        if let Some((value, _)) = init
            && quals.storage.is_some()
        {
            let at = self.loc(value);
            self.error(at, format!("`{text}` is an interface variable and cannot have an initialiser"));
        }
        if storage == GlobalStorage::Uniform && !self.settings.dialect.has_loose_uniforms() {
            self.error(name, format!("`{text}` cannot be a uniform here: Ghostty sets no uniforms but its own"));
            self.hint("make it a `const`, or a `#define`");
            self.declare(name, Binding::Poison);
            return;
        }
        let outer = (storage == GlobalStorage::Uniform).then(|| self.uniform_value(name, ty)).flatten();
        let is_set = outer.is_some() || self.env.is_plain() || storage == GlobalStorage::In && self.env.is_stage();
        if matches!(storage, GlobalStorage::Uniform | GlobalStorage::In) && !is_set {
            self.warning(name, format!("`{text}` has no value (0)"));
            if !self.env.is_main() {
                self.hint(shadertoy_input(text).unwrap_or(
                    "Shadertoy's inputs are iTime, iResolution, iMouse and so on; for other values use a `const` or a \
                 #define",
                ));
            }
            if storage == GlobalStorage::Uniform && !self.facts(ty).opaque {
                self.hint(format!("or set its value in eddy.toml: [uniforms], {text} = .."));
            }
        }
        let mut value = outer.flatten();
        let mut kept = None;
        match storage {
            GlobalStorage::Const => {
                value = self.const_value(name, ty, init);
                if value.is_none() {
                    storage = GlobalStorage::Private;
                }
            }
            GlobalStorage::Private => {
                if let Some((init, written)) = init.filter(|_| quals.storage.is_none())
                    && let Some(init) = self.check_init(name, ty, init, written)
                {
                    if self.is_constant(init) {
                        kept = Some(init);
                        value = self.as_const(init);
                    } else if self.settings.dialect.has_dynamic_globals() || self.reads_only_constants(init) {
                        kept = Some(init);
                    } else if !self.is_broken() {
                        self.not_constant_global(name, init);
                    }
                }
            }
            GlobalStorage::Uniform | GlobalStorage::In | GlobalStorage::Out => {}
        }
        let id = self.add_global(name, ty, storage, kept, value, loc);
        if self.env.is_plain() && storage == GlobalStorage::Uniform {
            self.plain_uniform(id, self.ast[spec].loc);
        }
        if quals.is(Q::Out) && !self.env.has_main() {
            self.outputs.push(id);
        }
        if quals.is(Q::In) && self.env.is_main() {
            self.inputs.push(id);
        }
        let location = self.location(quals);
        let global = &mut self.module[id];
        (global.flat, global.location) = (quals.flat, location);
    }

    /// Returns whether a variable already exists because the text of the vertex shader, which precedes this one,
    /// declares it as an output.
    fn is_of_other_stage(&self, name: Ident, ty: TypeId, init: Option<ExprId>) -> bool {
        self.settings.dialect.joins_stages()
            && init.is_none()
            && matches!(self.scopes.get_innermost(name.symbol), Some(Binding::Global(id)) if self.module[id].ty == ty)
    }

    /// Returns the number in a `layout(location = n)`.
    fn location(&mut self, quals: &Qualifiers) -> Option<u32> {
        let (_, items) = quals.layout?;
        let ast = self.ast;
        let item = ast[items].iter().find(|item| self.name(item.name.symbol) == "location")?;
        let value = self.expr(item.value?);
        match self.module[value].kind {
            ExprKind::Literal(bits) if (bits as i32) >= 0 && self.is_constant(value) => Some(bits),
            _ => {
                let at = self.loc(value);
                self.error(at, "a location is a number from 0");
                None
            }
        }
    }

    /// Returns whether an expression contains only constants. If it is nevertheless not a constant expression, it
    /// contains a comma operator (section 12.43). ANGLE accepts such an initialiser of a variable: its
    /// `ValidateGlobalInitializer` checks what is read and called, not the operators.
    fn reads_only_constants(&self, init: ExprId) -> bool {
        let mut left = vec![init];
        while let Some(expr) = left.pop() {
            match self.module[expr].kind {
                ExprKind::Error
                | ExprKind::Local(_)
                | ExprKind::Global(_)
                | ExprKind::Uniform(_)
                | ExprKind::CustomUniform(_)
                | ExprKind::Channel(_)
                | ExprKind::BuiltinVar(_)
                | ExprKind::Assign { .. }
                | ExprKind::AssignOp { .. }
                | ExprKind::IncDec { .. }
                | ExprKind::Call { .. } => return false,
                _ => self.module.parts(expr, &mut left),
            }
        }
        true
    }

    /// Reports an initialiser at file scope that is not a constant expression, which section 4.3 requires for any
    /// variable.
    #[cold]
    fn not_constant_global(&mut self, name: Ident, init: ExprId) {
        let (text, at) = (self.name(name.symbol), self.loc(init));
        self.error(at, format!("the global `{text}` must be initialised with a constant expression"));
        self.hint(format!("declare `{text}` without a value and assign it at the start of the entry point"));
        self.hint("or use a #define, which is expanded wherever it is used");
    }

    fn add_global(
        &mut self,
        name: Ident,
        ty: TypeId,
        storage: GlobalStorage,
        init: Option<ExprId>,
        value: Option<ConstId>,
        loc: Loc,
    ) -> GlobalId {
        self.module.globals.push(Global {
            name,
            ty,
            storage,
            init,
            value,
            loc,
            flags: VarFlags::default(),
            flat: false,
            location: None,
            block: None,
        });
        let id = GlobalId::new(self.module.globals.len() - 1);
        self.declare(name, Binding::Global(id));
        id
    }

    fn are_precise(&self, qualifiers: List<ast::Qualifier>) -> bool {
        self.ast[qualifiers].iter().all(|qualifier| qualifier.kind == Q::Precise)
    }

    /// Checks `invariant a, b;` and `layout(..) uniform;`.
    fn qualify(&mut self, qualifiers: List<ast::Qualifier>, names: List<Ident>, loc: Loc) {
        let quals = self.qualifiers(qualifiers, DeclContext::Global);
        if self.are_precise(qualifiers) {
            return;
        }
        let ast = self.ast;
        if ast[names].is_empty() {
            self.check_layout(&quals, LayoutOf::Block);
            self.refuse_row_major(&quals);
            if quals.layout.is_none() && quals.storage.is_none() {
                self.error(loc, "these qualifiers have no declaration");
            }
            return;
        }
        for &name in &ast[names] {
            let text = self.name(name.symbol);
            match self.scopes.get(name.symbol) {
                Binding::None => self.unknown_name(name.symbol, name.token),
                Binding::Poison => {}
                Binding::Global(id) if self.module[id].storage == GlobalStorage::Out && quals.invariant.is_some() => {}
                _ if quals.invariant.is_some() => {
                    self.error(name, format!("`{text}` is not an output and cannot be `invariant`"));
                }
                _ => {
                    self.error(name, format!("the qualifiers of `{text}` cannot be changed after its declaration"));
                }
            }
        }
    }

    /// Checks a uniform block: nothing fills it, so its members are zero.
    fn block(
        &mut self,
        qualifiers: List<ast::Qualifier>,
        name: Ident,
        fields: List<Field>,
        instance: Option<Ident>,
        dims: List<ast::Dim>,
        loc: Loc,
    ) {
        let ast = self.ast;
        let quals = self.qualifiers(qualifiers, DeclContext::Block);
        // GLSL 1.50, section 4.3.7: what an earlier stage passes.
        let is_input = quals.is(Q::In) && self.env.is_main();
        if !quals.is(Q::Uniform) && !is_input {
            self.error(name, "GLSL ES 3.00 has only `uniform` blocks");
        }
        self.check_layout(&quals, LayoutOf::Block);
        self.declare(name, Binding::Block(name));
        let mut members: Vec<StructMember> = Vec::new();
        let mut seen = FxHashSet::default();
        for field in &ast[fields] {
            let base = self.base_type(field.ty);
            let spec = ast[field.ty];
            let of_field = self.qualifiers(field.qualifiers, DeclContext::Block);
            self.check_layout(&of_field, LayoutOf::Member);
            if let Some((Q::In | Q::Out, token)) = of_field.storage
                && !is_input
            {
                self.error(token, "a member of a uniform block cannot be `in` or `out`");
            }
            for declarator in &ast[field.declarators] {
                let mut ty = self.complete_type(base, spec.dims, declarator.dims, "an array in a block");
                let text = self.name(declarator.name.symbol);
                if ty == TypeId::VOID || self.facts(ty).opaque {
                    let shown = self.type_name(ty);
                    self.error(spec.loc, format!("the member `{text}` of a block cannot be a `{shown}`"));
                    ty = TypeId::ERROR;
                }
                if !seen.insert(declarator.name.symbol) {
                    self.error(declarator.name, format!("this block already has a member `{text}`"));
                    continue;
                }
                members.push(StructMember { name: declarator.name, ty });
            }
        }
        if instance.is_none() {
            let count = members.len();
            members.retain(|member| !self.redeclared_member(member.name, member.ty));
            if members.is_empty() && count > 0 {
                return;
            }
        }
        let text = self.name(name.symbol);
        let is_plain = self.env.is_plain();
        if is_plain {
            self.plain_block(&quals, fields, dims);
        } else if is_input {
            self.warning(name, format!("the block `{text}` has no values (0): no vertex shader sets them"));
        } else {
            self.warning(name, format!("the uniform block `{text}` has no values: its members are 0"));
        }
        let block = is_plain.then_some(name.symbol);
        let Some(instance) = instance else {
            for member in members {
                let id = self.add_global(member.name, member.ty, GlobalStorage::Uniform, None, None, loc);
                self.module[id].block = block;
            }
            return;
        };
        let words: u32 = members.iter().fold(0u32, |sum, m| sum.saturating_add(self.facts(m.ty).words));
        if words > MAX_WORDS {
            self.error(loc, "this block takes more than the limit of 16 MiB");
        }
        let ty = self.add_struct(Some(name), &members, loc, None);
        let ty = self.complete_type(ty, dims, List::EMPTY, "an array of blocks");
        let id = self.add_global(instance, ty, GlobalStorage::Uniform, None, None, loc);
        self.module[id].block = block;
    }
}
