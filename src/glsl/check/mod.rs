//! Types, scopes and every rule of meaning: a syntax tree in, the typed program of [`super::hir`] and what is wrong out.
//!
//! Owns chapters 4 to 8 of the GLSL ES 3.00 specification: declarations, conversions (there are none), overloads, places,
//! constant expressions and their values, placement of statements, recursion, the site's uniforms and entry points. It judges
//! as WebGL 2 does (ANGLE, the site's compiler): what that refuses is an error, what only ANGLE refuses a warning. It reads
//! no text, only tokens' symbols, and decides nothing about how a construct is executed.
//!
//! One pass over the tree in text order. Expressions are checked in a loop over the arena (children come before parents), so
//! no chain of operators is too long; statements recurse, no deeper than the parser's nesting limit. A scope is an undo
//! stack over one table indexed by symbol, so looking a name up is one load.

mod access;
mod call;
mod construct;
mod conversion;
mod declare;
pub(in crate::glsl) mod env;
mod expr;
mod fold;
mod fold_builtin;
mod function;
mod given;
mod graph;
mod ops;
pub(in crate::glsl) mod overloads;
mod qualifiers;
mod scope;
mod size;
mod statement;
mod suggest;
mod types;
mod words;

#[cfg(test)]
mod tests;

use std::collections::HashMap;

use super::{
    ChannelKind, Knob, PassSource, UniformValue,
    ast::{self, Ast, Interner, Loc, Origins, Precision, Symbol},
    hir::{self, FuncId, Module, TypeId},
    report::MAX_ERRORS,
};
use crate::diag::{Diagnostic, SourceId};
use env::Env;
pub(crate) use env::knob_type;
use scope::Scopes;

/// A program, right or wrong: the module exists for any tree, lowering wants one without errors.
#[derive(Debug)]
pub(crate) struct Checked {
    pub module: Module,
    /// In the order in which they were found, which is text order but for what concerns the whole program.
    pub diagnostics: Vec<Diagnostic>,
}

/// Who has a name already that an author's own uniform would need.
pub(crate) fn taken(name: &str) -> Option<&'static str> {
    env::taken(name)
}

/// Checks one pass, whose texts `ast` is of.
pub(crate) fn check(ast: &Ast, origins: &Origins, names: &Interner, source: &PassSource<'_>) -> Checked {
    let mut checker = Checker::new(ast, origins, names, Env::Pass(source.kind), source.channels, source.knobs);
    checker.values = source.values;
    checker.common = source.common.map(|text| text.id);
    checker.unit();
    Checked { module: checker.module, diagnostics: checker.diagnostics }
}

/// What the site would refuse in Common because it compiles it alone, where only `iDate` and `iSampleRate` exist: one warning
/// for each name that only passes have. What is wrong in any case is left to the passes, which report it.
pub(crate) fn check_common(ast: &Ast, origins: &Origins, names: &Interner, knobs: &[Knob<'_>]) -> Vec<Diagnostic> {
    let mut checker = Checker::new(ast, origins, names, Env::Common, [ChannelKind::Sampler2D; 4], knobs);
    checker.unit();
    checker.refused_in_common
}

/// What the checker knows of a type beyond [`hir::Type`]; found once, when the type is made.
#[derive(Clone, Copy)]
struct TypeFacts {
    /// Scalars in a value of it, up to [`types::MAX_WORDS`].
    words: u32,
    /// Is or holds a sampler.
    opaque: bool,
    /// Is or holds an array.
    arrays: bool,
    /// Structs inside one another.
    nesting: u8,
}

/// Per function of [`Module::functions`], what only the checker needs.
struct FuncFacts {
    /// Next overload of the same name.
    next: Option<FuncId>,
    /// Of the first overload: the last one.
    last: FuncId,
    /// First place it is called from, for messages about what cannot be called.
    first_call: Option<Loc>,
    /// Stamp of the last function that was seen calling this one, so that `calls` names it once.
    called_by: u32,
}

struct Checker<'a> {
    ast: &'a Ast,
    origins: &'a Origins,
    names: &'a Interner,
    env: Env,
    channels: [ChannelKind; 4],
    knobs: &'a [Knob<'a>],
    values: &'a [UniformValue],
    /// The parser reported something, so nodes may lie between others without belonging to the tree.
    broken_tree: bool,
    module: Module,
    diagnostics: Vec<Diagnostic>,
    /// How many of them were errors, those that were not kept among them.
    errors: usize,
    refused_in_common: Vec<Diagnostic>,
    scopes: Scopes,
    /// HIR of each checked expression of the tree.
    lowered: Vec<Option<hir::ExprId>>,
    /// Where the HIR of the full expression at hand, or of the last one, begins.
    full_expr: usize,
    facts: Vec<TypeFacts>,
    /// Of structs with many members: position of each, and how many words precede it.
    members: HashMap<(hir::StructId, Symbol), (usize, usize)>,
    funcs: Vec<FuncFacts>,
    /// Of names with several: the overload of the first one's name that takes these types.
    overloads: HashMap<(FuncId, Vec<TypeId>), FuncId>,
    /// Scalars that folded constants hold, and that were compared.
    folded_words: usize,
    /// `precision` statements in force, by [`ast::BasicType`]; changed seldom, so scopes save the whole.
    precisions: [Option<Precision>; ast::BasicType::ALL.len()],
    saved_precisions: Vec<(u32, [Option<Precision>; ast::BasicType::ALL.len()])>,
    /// The function whose body is being checked.
    func: Option<FuncId>,
    /// It has a `return` with a value.
    returns: bool,
    loops: u32,
    /// Type of the value of the enclosing switches, innermost last.
    switches: Vec<statement::Switch>,
    /// Functions that initialisers of globals call.
    global_calls: Vec<FuncId>,
    /// Scratch stacks: lists nest, and live above the length at which their owner found them.
    expr_stack: Vec<hir::ExprId>,
    stmt_stack: Vec<hir::StmtId>,
    word_stack: Vec<u32>,
    /// `iCh0` and its like that wait for their `.member`.
    pending_channels: Vec<(hir::ExprId, u8)>,
    /// By symbol: 1 + index of the function in which it was reported as unknown, so that it is said once.
    unknown_said: Vec<u32>,
    /// Struct of `gl_DepthRange` once it was named.
    depth_range: Option<hir::ConstId>,
    entry_symbol: Option<Symbol>,
    /// The text that other stages have too.
    common: Option<SourceId>,
}

impl<'a> Checker<'a> {
    fn new(
        ast: &'a Ast,
        origins: &'a Origins,
        names: &'a Interner,
        env: Env,
        channels: [ChannelKind; 4],
        knobs: &'a [Knob<'a>],
    ) -> Self {
        let broken_tree = ast.exprs.iter().any(|e| matches!(e.kind, ast::ExprKind::Error))
            || ast.stmts.iter().any(|s| matches!(s.kind, ast::StmtKind::Error))
            || ast.decls.iter().any(|d| matches!(d.kind, ast::DeclKind::Error))
            || ast.types.iter().any(|t| matches!(t.kind, ast::TypeSpecKind::Error));
        let mut module = Module::default();
        module.exprs.reserve(ast.exprs.len() + ast.exprs.len() / 4);
        module.stmts.reserve(ast.stmts.len());
        module.uses.reserve(ast.exprs.len() / 2);
        let facts = types::basic_facts(&module.types);
        let mut checker = Self {
            ast,
            origins,
            names,
            env,
            channels,
            knobs,
            values: &[],
            broken_tree,
            module,
            diagnostics: Vec::new(),
            errors: 0,
            refused_in_common: Vec::new(),
            scopes: Scopes::new(names.len()),
            lowered: vec![None; ast.exprs.len()],
            full_expr: 0,
            facts,
            members: HashMap::new(),
            funcs: Vec::new(),
            overloads: HashMap::new(),
            folded_words: 0,
            precisions: [None; ast::BasicType::ALL.len()],
            saved_precisions: Vec::new(),
            func: None,
            returns: false,
            loops: 0,
            switches: Vec::new(),
            global_calls: Vec::new(),
            expr_stack: Vec::new(),
            stmt_stack: Vec::new(),
            word_stack: Vec::new(),
            pending_channels: Vec::new(),
            unknown_said: Vec::new(),
            depth_range: None,
            entry_symbol: None,
            common: None,
        };
        checker.declare_environment();
        checker.declare_knobs();
        checker
    }

    /// The whole translation unit.
    fn unit(&mut self) {
        for i in 0..self.ast.items.len() {
            self.global_declaration(self.ast.items[i]);
        }
        self.finish_entry();
        self.finish_calls();
        if self.errors == 0 && !self.broken_tree && self.module.entry.is_some() {
            self.finish_size();
        }
    }

    /// Reports an error; hints and labels are added to what comes back.
    #[cold]
    fn error(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> &mut Diagnostic {
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
    fn is_full(&self) -> bool {
        self.errors > MAX_ERRORS
    }

    #[cold]
    fn warning(&mut self, loc: impl Into<Loc>, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = self.origins.warning(self.names, loc, message);
        self.diagnostics.push(diagnostic);
        self.diagnostics.last_mut().expect("just pushed")
    }

    /// Adds a second place to the diagnostic reported last.
    #[cold]
    fn also(&mut self, loc: impl Into<Loc>, message: impl Into<String>) {
        let span = self.origins.span(loc.into());
        if let Some(last) = self.diagnostics.last_mut() {
            last.labels.push(crate::diag::Label { span, message: message.into() });
        }
    }

    /// Adds a mend to the diagnostic reported last.
    #[cold]
    fn hint(&mut self, hint: impl Into<String>) {
        if let Some(last) = self.diagnostics.last_mut() {
            last.hints.push(hint.into());
        }
    }

    /// Whether this stands in Common, which a vertex stage has before it though half of it may be for fragments: what nobody
    /// calls there does no harm.
    fn is_shared(&self, loc: Loc) -> bool {
        self.common == Some(self.origins.span(loc).source)
    }

    /// Remembers what a name in the text refers to, for editors.
    #[inline]
    fn uses(&mut self, token: ast::TokenId, target: hir::DeclRef) {
        self.module.uses.push(hir::Use { token, target });
    }

    fn name(&self, symbol: Symbol) -> &'a str {
        self.names.get(symbol)
    }

    #[inline]
    fn ty(&self, expr: hir::ExprId) -> TypeId {
        self.module[expr].ty
    }

    #[inline]
    fn loc(&self, expr: hir::ExprId) -> Loc {
        self.module[expr].loc
    }
}
