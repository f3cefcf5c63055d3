//! The checker's state and what every rule of it needs: reports, places, types. The rules are in the files beside.

use super::{
    checkpoint::{Checkpoint, Precisions},
    env::Env,
    facts::{FuncFacts, TypeFacts},
    fault::Fault,
    scope::Scopes,
};
use crate::{
    ast::{self, Ast, Interner, Loc, Origins, Symbol},
    cancel::Cancel,
    hir::{self, FuncId, Module, TypeId},
    near::Budget,
    report::MAX_ERRORS,
    source::{ChannelKind, CustomUniform, Dialect, SLOTS, UniformValue},
};
use eddy_diag::{Diagnostic, Fix, SourceId, Span};
use rustc_hash::FxHashMap;

/// A switch whose body is being checked.
pub(super) struct Switch {
    /// The type of its value; the error type silences its labels.
    pub ty: TypeId,
    /// Labels so far, and where they stand.
    pub values: FxHashMap<u32, Loc>,
    pub default: Option<Loc>,
}

/// Settings of the project beside its texts.
#[derive(Clone, Copy, Default)]
pub(super) struct Settings<'a> {
    pub dialect: Dialect,
    pub channels: [ChannelKind; SLOTS],
    pub custom_uniforms: &'a [CustomUniform<'a>],
    pub values: &'a [UniformValue],
    /// The text that other stages have too.
    pub common: Option<SourceId>,
    pub cancel: Cancel<'a>,
}

pub(super) struct Checker<'a> {
    pub ast: &'a Ast,
    pub origins: &'a Origins,
    pub names: &'a Interner,
    pub env: Env,
    pub settings: Settings<'a>,
    /// The parser reported something, so nodes may lie between others without belonging to the tree.
    pub broken_tree: bool,
    pub module: Module,
    pub diagnostics: Vec<Diagnostic>,
    /// Operations on constants whose results are open or no finite numbers.
    pub faults: Vec<Fault>,
    /// The number of errors, those that were not kept among them.
    pub errors: usize,
    pub refused_in_common: Vec<Diagnostic>,
    pub scopes: Scopes,
    /// HIR of each checked expression of the tree.
    pub lowered: Vec<Option<hir::ExprId>>,
    /// Says where the HIR of the full expression at hand, or of the last one, begins.
    pub full_expr: usize,
    pub facts: Vec<TypeFacts>,
    /// Position of each member of structs with many, and how many words precede it.
    pub members: FxHashMap<(hir::StructId, Symbol), (usize, usize)>,
    pub funcs: Vec<FuncFacts>,
    /// The overload that takes these types, by the first one of its name; of names with several alone.
    pub overloads: FxHashMap<(FuncId, Vec<TypeId>), FuncId>,
    /// Scalars that folded constants hold, and that were compared.
    pub folded_words: usize,
    /// `precision` statements in force, by [`ast::BasicType`]; changed seldom, so scopes save the whole.
    pub precisions: Precisions,
    pub saved_precisions: Vec<(u32, Precisions)>,
    /// The function whose body is being checked.
    pub func: Option<FuncId>,
    /// It has a `return` with a value.
    pub returns: bool,
    pub loops: u32,
    /// Type of the value of the enclosing switches, innermost last.
    pub switches: Vec<Switch>,
    /// Functions that initialisers of globals call.
    pub global_calls: Vec<FuncId>,
    /// The name of the function that most of a program without errors lies in.
    pub bulk: Option<Loc>,
    /// Scratch stacks: lists nest, and live above the length at which their owner found them.
    pub expr_stack: Vec<hir::ExprId>,
    pub stmt_stack: Vec<hir::StmtId>,
    pub word_stack: Vec<u32>,
    /// `iCh0` and its like that wait for their `.member`.
    pub pending_channels: Vec<(hir::ExprId, u8)>,
    /// By symbol: 1 + index of the function in which it was reported as unknown, so that it is said once.
    pub unknown_said: Vec<u32>,
    /// The work that is left to find what unknown names may be slips of.
    pub suggestions: Budget,
    /// An expression was refused because its tree is too deep.
    pub too_deep_told: bool,
    /// Outputs at file scope of a pass that is no stage.
    pub outputs: Vec<hir::GlobalId>,
    /// Struct of `gl_DepthRange` once it was named.
    pub depth_range: Option<hir::ConstId>,
    pub entry_symbol: Option<Symbol>,
    /// The entry point as the site's header declares it.
    pub header_entry: Option<FuncId>,
    /// The `main` that stands for the entry point: its name, and which diagnostic says so.
    pub foreign_main: Option<(FuncId, usize)>,
    /// The number of [`Ast::items`] that were checked.
    pub items: usize,
}

impl<'a> Checker<'a> {
    /// Stands behind what is `begun`, or before all text where nothing is.
    pub fn new(
        ast: &'a Ast,
        origins: &'a Origins,
        names: &'a Interner,
        env: Env,
        settings: Settings<'a>,
        checkpoint: Option<&Checkpoint>,
    ) -> Self {
        let broken_tree = ast.exprs.iter().any(|e| matches!(e.kind, ast::ExprKind::Error))
            || ast.stmts.iter().any(|s| matches!(s.kind, ast::StmtKind::Error))
            || ast.decls.iter().any(|d| matches!(d.kind, ast::DeclKind::Error))
            || ast.types.iter().any(|t| matches!(t.kind, ast::TypeSpecKind::Error));
        let mut checkpoint = checkpoint.map_or_else(Checkpoint::nothing, Checkpoint::clone);
        let known = Symbol(checkpoint.scopes.symbols() as u32);
        checkpoint.scopes.reserve_symbols(names.len());
        checkpoint.module.reserve(ast, checkpoint.lowered.len());
        checkpoint.lowered.resize(ast.exprs.len(), None);
        let mut checker = Self {
            ast,
            origins,
            names,
            env,
            settings,
            broken_tree,
            module: checkpoint.module,
            diagnostics: checkpoint.diagnostics,
            faults: checkpoint.faults,
            errors: 0,
            refused_in_common: Vec::new(),
            scopes: checkpoint.scopes,
            lowered: checkpoint.lowered,
            full_expr: 0,
            facts: checkpoint.facts,
            members: checkpoint.members,
            funcs: checkpoint.funcs,
            overloads: checkpoint.overloads,
            folded_words: checkpoint.folded_words,
            precisions: checkpoint.precisions,
            saved_precisions: Vec::new(),
            func: None,
            returns: false,
            loops: 0,
            switches: Vec::new(),
            global_calls: checkpoint.global_calls,
            bulk: None,
            expr_stack: Vec::new(),
            stmt_stack: Vec::new(),
            word_stack: Vec::new(),
            pending_channels: Vec::new(),
            unknown_said: Vec::new(),
            suggestions: Budget::default(),
            outputs: Vec::new(),
            too_deep_told: false,
            depth_range: checkpoint.depth_range,
            entry_symbol: None,
            header_entry: None,
            foreign_main: None,
            items: checkpoint.items,
        };
        checker.declare_language(known);
        checker
    }

    /// Checks the declarations that were not checked yet.
    pub fn declarations(&mut self) {
        while let Some(&item) = self.ast.items.get(self.items) {
            self.settings.cancel.check();
            self.global_declaration(item);
            self.items += 1;
        }
    }

    /// The whole translation unit.
    pub fn unit(&mut self) {
        self.declare_pass();
        self.declarations();
        self.finish_outputs();
        self.finish_entry();
        self.finish_calls();
        if self.errors == 0 && !self.broken_tree && self.module.entry.is_some() {
            self.finish_size();
            self.finish_float_hashes();
        }
    }

    /// Reports an error; hints and labels are added to what comes back.
    #[cold]
    pub fn error(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = self.origins.error(self.names, loc, message);
        // The report keeps no more errors than that: one place is enough for all others.
        if self.is_full() && self.diagnostics.last().is_some_and(Diagnostic::is_error) {
            self.diagnostics.pop();
        }
        self.errors += 1;
        self.diagnostics.push(diagnostic);
        self.diagnostics.last_mut().expect("just pushed")
    }

    /// More errors than are shown: what takes a search through the program to be said is not said any more.
    pub fn is_full(&self) -> bool {
        self.errors > MAX_ERRORS
    }

    #[cold]
    pub fn warning(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = self.origins.warning(self.names, loc, message);
        self.diagnostics.push(diagnostic);
        self.diagnostics.last_mut().expect("just pushed")
    }

    /// Adds a second place to the diagnostic reported last.
    #[cold]
    pub fn also(&mut self, loc: impl Into<Loc>, message: impl Into<String>) {
        let span = self.origins.span(loc.into());
        if let Some(last) = self.diagnostics.last_mut() {
            last.labels.push(eddy_diag::Label { span, message: eddy_diag::shortened(message) });
        }
    }

    /// Adds a mend to the diagnostic reported last.
    #[cold]
    pub fn hint(&mut self, hint: impl Into<String>) {
        if let Some(last) = self.diagnostics.last_mut() {
            last.hints.push(eddy_diag::shortened(hint));
        }
    }

    /// Adds a mend that an editor can make to the diagnostic reported last.
    #[cold]
    pub fn fix(&mut self, fix: Option<Fix>) {
        if let Some(last) = self.diagnostics.last_mut() {
            last.fixes.extend(fix);
        }
    }

    /// Returns where the author wrote something, if no macro brought it in: an edit of a macro is one of all its uses.
    pub fn written_at(&self, loc: impl Into<Loc>) -> Option<Span> {
        let loc = loc.into();
        let (first, last) = (self.origins.tokens[loc.first.0 as usize], self.origins.tokens[loc.last.0 as usize]);
        let is_plain = first.expansion.is_none() && last.expansion.is_none();
        let is_one = first.spelled.source == last.spelled.source && first.spelled.start <= last.spelled.end;
        (is_plain && is_one).then(|| first.spelled.to(last.spelled))
    }

    /// Adds the mend that puts another text in the place of what is written.
    pub fn fix_with(&mut self, loc: impl Into<Loc>, text: &str) {
        let span = self.written_at(loc);
        self.fix(span.map(|span| Fix::replace(span, text)));
    }

    /// Says that a name was probably spelled wrong.
    pub fn did_you_mean(&mut self, loc: impl Into<Loc>, near: &str) {
        self.hint(format!("did you mean `{near}`?"));
        self.fix_with(loc, near);
    }

    /// Returns whether this stands in Common, which a vertex stage has before it though half of it may be for
    /// fragments: what nobody calls there does no harm.
    pub fn is_shared(&self, loc: Loc) -> bool {
        self.settings.common == Some(self.origins.span(loc).source)
    }

    /// Remembers what a name in the text refers to, for editors.
    #[inline]
    pub fn uses(&mut self, token: ast::TokenId, target: hir::DeclRef) {
        self.module.uses.push(hir::Use { token, target });
    }

    pub fn name(&self, symbol: Symbol) -> &'a str {
        self.names.get(symbol)
    }

    #[inline]
    pub fn ty(&self, expr: hir::ExprId) -> TypeId {
        self.module[expr].ty
    }

    #[inline]
    pub fn loc(&self, expr: hir::ExprId) -> Loc {
        self.module[expr].loc
    }
}

impl Checker<'_> {
    /// Ends behind the declarations that were checked; `None` where one of them has an error.
    pub(super) fn into_begun(self) -> Option<Checkpoint> {
        // Whether an output does harm is known at the end of the pass.
        (self.errors == 0 && !self.broken_tree && self.outputs.is_empty()).then_some(Checkpoint {
            items: self.items,
            module: self.module,
            diagnostics: self.diagnostics,
            faults: self.faults,
            scopes: self.scopes,
            lowered: self.lowered,
            facts: self.facts,
            members: self.members,
            funcs: self.funcs,
            overloads: self.overloads,
            folded_words: self.folded_words,
            precisions: self.precisions,
            global_calls: self.global_calls,
            depth_range: self.depth_range,
        })
    }
}
