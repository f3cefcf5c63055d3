//! The front end: reads and checks the texts of a pass, for all callers that need a checked program.

use super::{
    ast::{Interner, Origins},
    check, dialects, hir, parse,
    preamble::Preamble,
    report::Report,
    source::PassSource,
    stages::{self, Interface, Link},
};
use eddy_diag::{Diagnostic, Span};

/// A pass that was read and checked, with its diagnostics.
pub(super) struct FrontEnd {
    pub module: hir::Module,
    pub interface: Interface,
    pub origins: Origins,
    pub names: Interner,
    /// In the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    pub faults: Vec<check::Fault>,
    /// See [`check::Checked::bulk`].
    pub largest_function: Option<Span>,
}

impl FrontEnd {
    /// Reads and checks a pass. The `preamble` is that of its own Common; it saves time and does not change the result.
    pub(crate) fn run(source: &PassSource<'_>, link: &Link<'_>, preamble: Option<&Preamble>) -> Self {
        let preamble = preamble.filter(|_| source.common.is_some());
        let parsed = parse::parse(source, preamble.map(Preamble::parsed));
        let checkpoint = preamble.and_then(|preamble| preamble.checked(source));
        let mut checked = check::check(&parsed.ast, &parsed.origins, &parsed.names, source, checkpoint);
        let interface =
            stages::interface(&checked.module, &parsed.names, &parsed.origins, source, link, &mut checked.diagnostics);
        let mut all = Report::default();
        parsed.report.diagnostics.into_iter().chain(checked.diagnostics).for_each(|d| all.add(d));
        all.diagnostics.sort_by_key(|d| d.span.map(|s| (s.source, s.start)));
        if all.has_errors()
            && let Some(named) = dialects::name(source, &all.diagnostics)
        {
            all.diagnostics = vec![named];
        }
        Self {
            module: checked.module,
            interface,
            origins: parsed.origins,
            names: parsed.names,
            diagnostics: all.diagnostics,
            faults: checked.faults,
            largest_function: checked.largest_function,
        }
    }

    pub(crate) fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}
