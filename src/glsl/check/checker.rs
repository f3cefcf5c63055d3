//! The checker's state and shared helpers: reports, places, types. The rules are in the other files of this folder.

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
    source::{ChannelKind, CustomUniform, Dialect, MAX_CHANNELS, NamedSampler, UniformValue},
};
use eddy_diag::{Diagnostic, Fix, SourceId, Span};
use rustc_hash::FxHashMap;

/// A switch whose body is being checked.
pub(super) struct Switch {
    /// The type of its value; the error type suppresses diagnostics about its labels.
    pub ty: TypeId,
    /// The labels so far, and their locations.
    pub values: FxHashMap<u32, Loc>,
    pub default: Option<Loc>,
}

/// The settings of the project apart from its texts.
#[derive(Clone, Copy, Default)]
pub(super) struct Settings<'a> {
    pub dialect: Dialect,
    pub channels: [ChannelKind; MAX_CHANNELS],
    pub custom_uniforms: &'a [CustomUniform<'a>],
    pub samplers: &'a [NamedSampler<'a>],
    pub values: &'a [UniformValue],
    /// The text that is shared with other stages.
    pub common: Option<SourceId>,
    pub cancel: Cancel<'a>,
}

pub(super) struct Checker<'a> {
    pub ast: &'a Ast,
    pub origins: &'a Origins,
    pub names: &'a Interner,
    pub env: Env,
    pub settings: Settings<'a>,
    /// The parser reported errors, so nodes may exist that are not part of the tree.
    pub broken_tree: bool,
    pub module: Module,
    pub diagnostics: Vec<Diagnostic>,
    /// Operations on constants whose results are undefined or not finite numbers.
    pub faults: Vec<Fault>,
    /// The number of errors, including those that were not kept.
    pub errors: usize,
    pub refused_in_common: Vec<Diagnostic>,
    pub scopes: Scopes,
    /// The HIR of each checked expression of the tree.
    pub lowered: Vec<Option<hir::ExprId>>,
    /// The first HIR expression of the current full expression, or of the last one.
    pub full_expr: usize,
    pub facts: Vec<TypeFacts>,
    /// The index of each member of structs with many members, and the number of words before it.
    pub members: FxHashMap<(hir::StructId, Symbol), (usize, usize)>,
    pub funcs: Vec<FuncFacts>,
    /// The overload that takes these types, by the first one of its name; only for names with several.
    pub overloads: FxHashMap<(FuncId, Vec<TypeId>), FuncId>,
    /// The number of scalars in folded constants and their comparisons.
    pub folded_words: usize,
    /// The `precision` statements in force, by [`ast::BasicType`]; they change rarely, so scopes save all of them.
    pub precisions: Precisions,
    pub saved_precisions: Vec<(u32, Precisions)>,
    /// The function whose body is being checked.
    pub func: Option<FuncId>,
    /// The function has a `return` with a value.
    pub returns: bool,
    pub loops: u32,
    /// The enclosing switches, innermost last.
    pub switches: Vec<Switch>,
    /// The functions that initialisers of globals call.
    pub global_calls: Vec<FuncId>,
    /// The name of the function that makes up the largest part of an error-free program.
    pub largest_function: Option<Loc>,
    /// Scratch stacks: lists nest, and each uses the part above the length at which it started.
    pub expr_stack: Vec<hir::ExprId>,
    pub stmt_stack: Vec<hir::StmtId>,
    pub word_stack: Vec<u32>,
    /// `iCh0` and the like whose `.member` has not been checked yet.
    pub pending_channels: Vec<(hir::ExprId, u8)>,
    /// By symbol: 1 + index of the function in which it was reported as unknown, so that it is reported once.
    pub reported_unknown: Vec<u32>,
    /// The budget that is left for suggesting names.
    pub suggestions: Budget,
    /// An expression was rejected because its tree is too deep.
    pub reported_too_deep: bool,
    /// Outputs at file scope of a pass that is not a stage.
    pub outputs: Vec<hir::GlobalId>,
    /// Variables that an earlier stage would set, in a complete fragment shader.
    pub inputs: Vec<hir::GlobalId>,
    /// The struct of `gl_DepthRange`, once it was named.
    pub depth_range: Option<hir::ConstId>,
    pub entry_symbol: Option<Symbol>,
    /// The entry point as Shadertoy's header declares it.
    pub header_entry: Option<FuncId>,
    /// The `main` that was written instead of the entry point: its name, and the index of the diagnostic about it.
    pub foreign_main: Option<(FuncId, usize)>,
    /// The number of [`Ast::items`] checked so far.
    pub items: usize,
}

impl<'a> Checker<'a> {
    /// Creates a checker that continues from the `checkpoint`, or starts at the first text if there is none.
    pub(super) fn new(
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
            largest_function: None,
            expr_stack: Vec::new(),
            stmt_stack: Vec::new(),
            word_stack: Vec::new(),
            pending_channels: Vec::new(),
            reported_unknown: Vec::new(),
            suggestions: Budget::default(),
            outputs: Vec::new(),
            inputs: Vec::new(),
            reported_too_deep: false,
            depth_range: checkpoint.depth_range,
            entry_symbol: None,
            header_entry: None,
            foreign_main: None,
            items: checkpoint.items,
        };
        checker.declare_language(known);
        checker
    }

    /// Checks the declarations that have not been checked yet.
    pub(super) fn declarations(&mut self) {
        while let Some(&item) = self.ast.items.get(self.items) {
            self.settings.cancel.check();
            self.global_declaration(item);
            self.items += 1;
        }
    }

    /// Checks the whole translation unit.
    pub(super) fn unit(&mut self) {
        self.declare_pass();
        self.declarations();
        self.finish_outputs();
        self.finish_inputs();
        self.finish_entry();
        self.finish_calls();
        if self.errors == 0 && !self.broken_tree && self.module.entry.is_some() {
            self.finish_size();
            self.finish_float_hashes();
        }
    }

    /// Reports an error; hints and labels are added to the returned diagnostic.
    #[cold]
    pub(super) fn error(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = self.origins.error(self.names, loc, message);
        // The report keeps no more errors than that, so the slot of the last one is reused.
        if self.is_full() && self.diagnostics.last().is_some_and(Diagnostic::is_error) {
            self.diagnostics.pop();
        }
        self.errors += 1;
        self.diagnostics.push(diagnostic);
        self.diagnostics.last_mut().expect("just pushed")
    }

    /// Returns whether there are more errors than are shown: diagnostics that need a search through the program are
    /// then skipped.
    pub(super) fn is_full(&self) -> bool {
        self.errors > MAX_ERRORS
    }

    #[cold]
    pub(super) fn warning(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = self.origins.warning(self.names, loc, message);
        self.diagnostics.push(diagnostic);
        self.diagnostics.last_mut().expect("just pushed")
    }

    /// Adds a second location to the diagnostic reported last.
    #[cold]
    pub(super) fn label(&mut self, loc: impl Into<Loc>, message: impl Into<String>) {
        let span = self.origins.span(loc.into());
        if let Some(last) = self.diagnostics.last_mut() {
            last.labels.push(eddy_diag::Label { span, message: eddy_diag::shortened(message) });
        }
    }

    /// Adds a hint to the diagnostic reported last.
    #[cold]
    pub(super) fn hint(&mut self, hint: impl Into<String>) {
        if let Some(last) = self.diagnostics.last_mut() {
            last.hints.push(eddy_diag::shortened(hint));
        }
    }

    /// Adds a fix that an editor can apply to the diagnostic reported last.
    #[cold]
    pub(super) fn fix(&mut self, fix: Option<Fix>) {
        if let Some(last) = self.diagnostics.last_mut() {
            last.fixes.extend(fix);
        }
    }

    /// Returns the span that the author wrote, unless a macro produced it: an edit of a macro affects all its uses.
    pub(super) fn source_span(&self, loc: impl Into<Loc>) -> Option<Span> {
        let loc = loc.into();
        let (first, last) = (self.origins.tokens[loc.first.0 as usize], self.origins.tokens[loc.last.0 as usize]);
        let is_plain = first.expansion.is_none() && last.expansion.is_none();
        let is_one = first.spelled.source == last.spelled.source && first.spelled.start <= last.spelled.end;
        (is_plain && is_one).then(|| first.spelled.to(last.spelled))
    }

    /// Adds the fix that replaces what is written with another text.
    pub(super) fn replace_fix(&mut self, loc: impl Into<Loc>, text: &str) {
        let span = self.source_span(loc);
        self.fix(span.map(|span| Fix::replace(span, text)));
    }

    /// Suggests a name as the correct spelling of another.
    pub(super) fn did_you_mean(&mut self, loc: impl Into<Loc>, near: &str) {
        self.hint(format!("did you mean `{near}`?"));
        self.replace_fix(loc, near);
    }

    /// Returns whether a location is in Common, which a vertex stage includes although parts of it may be for
    /// fragments: functions that are not called there are harmless.
    pub(super) fn is_shared(&self, loc: Loc) -> bool {
        self.settings.common == Some(self.origins.span(loc).source)
    }

    /// Records the target of a name in the text, for editors.
    #[inline]
    pub(super) fn record_use(&mut self, token: ast::TokenId, target: hir::DeclRef) {
        self.module.uses.push(hir::Use { token, target });
    }

    pub(super) fn name(&self, symbol: Symbol) -> &'a str {
        self.names.get(symbol)
    }

    #[inline]
    pub(super) fn ty(&self, expr: hir::ExprId) -> TypeId {
        self.module[expr].ty
    }

    #[inline]
    pub(super) fn loc(&self, expr: hir::ExprId) -> Loc {
        self.module[expr].loc
    }
}

impl Checker<'_> {
    /// Returns the checkpoint after the checked declarations; `None` if one of them has an error.
    pub(super) fn into_checkpoint(self) -> Option<Checkpoint> {
        // Whether an output is an error is only known at the end of the pass.
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
