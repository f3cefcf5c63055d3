//! Finds what a probe asks for: the expression at a place of the text.

use super::{
    ast::Origins,
    hir::{ExprId, ExprKind, Module, StmtKind},
};
use crate::diag::{SourceId, Span};

/// A value that is drawn instead of what the pass draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Probe {
    pub source: SourceId,
    /// A byte of the text: the innermost expression there is meant; at the name of a variable that is declared, its
    /// first value.
    pub at: u32,
    /// The value when it is computed for the time after so many, counted for each pixel.
    pub visit: u32,
}

/// The expression that a probe means, and its part of the text.
pub(super) fn find(module: &Module, origins: &Origins, probe: &Probe) -> Option<(ExprId, Span)> {
    let covers = |span: &Span| span.source == probe.source && (span.start..=span.end).contains(&probe.at);
    let mut places = vec![false; module.exprs.len()];
    for expr in &module.exprs {
        // What is assigned to is a place; its value is that of the assignment.
        if let ExprKind::Assign { place, .. } | ExprKind::AssignOp { place, .. } | ExprKind::IncDec { place, .. } =
            expr.kind
        {
            places[place.index()] = true;
        }
    }
    let mut best: Option<(ExprId, Span)> = None;
    let mut offer = |id: ExprId, span: Span| {
        let is_better = best.is_none_or(|(_, other)| span.end - span.start < other.end - other.start);
        if is_better {
            best = Some((id, span));
        }
    };
    for (index, expr) in module.exprs.iter().enumerate().filter(|(index, _)| !places[*index]) {
        let span = origins.span(expr.loc);
        if covers(&span) {
            offer(ExprId::new(index), span);
        }
    }
    for stmt in &module.stmts {
        if let StmtKind::Declare { local, init: Some(init) } = stmt.kind
            && let Some(name) = module[local].name
            && covers(&origins.token_span(name.token))
        {
            offer(init, origins.token_span(name.token));
        }
    }
    best.map(|(id, span)| (id, if module[id].loc == Default::default() { span } else { origins.span(module[id].loc) }))
}
