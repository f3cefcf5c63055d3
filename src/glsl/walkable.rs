//! A pass as the walker takes it: lowered, with no pass of the optimiser and no work-around, and with the names and
//! places of the author's text.

use super::{
    PassSource,
    ast::{Interner, Loc, Origins},
    check, ir, lower, parse, report,
    stages::{self, Link},
    types::StructId,
};
use crate::diag::{Diagnostic, Span};

/// A program to walk through.
pub(crate) struct Walkable {
    pub program: ir::Module,
    names: lower::Names,
    origins: Origins,
    interner: Interner,
}

impl Walkable {
    /// Lowers a pass. On failure the list holds at least one error.
    pub fn new(source: &PassSource<'_>) -> Result<Self, Vec<Diagnostic>> {
        let parsed = parse::parse(source, None);
        let mut checked = check::check(&parsed.ast, &parsed.origins, &parsed.names, source, None);
        let interface = stages::interface(
            &checked.module,
            &parsed.names,
            &parsed.origins,
            source.kind,
            &Link::default(),
            &mut checked.diagnostics,
        );
        let mut all = report::Report::default();
        parsed.report.diagnostics.into_iter().chain(checked.diagnostics).for_each(|d| all.add(d));
        if all.diagnostics.iter().any(Diagnostic::is_error) {
            return Err(all.diagnostics);
        }
        let lower::Lowered { program, names, .. } = lower::lower(&checked.module, source, interface);
        Ok(Self { program, names, origins: parsed.origins, interner: parsed.names })
    }

    /// Where a value is written: for what a macro brought in, the use of the macro.
    pub fn span(&self, loc: Loc) -> Span {
        self.origins.span(loc)
    }

    /// The name of a function; none of the code around the author's.
    pub fn function_name(&self, function: ir::FuncId) -> Option<&str> {
        self.names.functions[function.index()].name.map(|symbol| self.interner.get(symbol))
    }

    /// The author's variables of a function: each with its name and the value or place that it is.
    pub fn locals(&self, function: ir::FuncId) -> impl Iterator<Item = (&str, ir::Value)> {
        self.names.functions[function.index()].locals.iter().map(|&(symbol, value)| (self.interner.get(symbol), value))
    }

    /// The name of a member of a structure.
    pub fn member_name(&self, structure: StructId, index: u32) -> &str {
        self.interner.get(self.names.members[structure.index()][index as usize])
    }

    /// The author's name of a variable of the module.
    pub fn global_name(&self, global: ir::GlobalId) -> Option<&str> {
        let named = self.names.globals.iter().find(|(_, id)| *id == global);
        named.map(|&(symbol, _)| self.interner.get(symbol))
    }
}
