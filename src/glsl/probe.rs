//! Probes: the expression at a position in the text, and how to read the picture of its value.

use super::{
    ast::Origins,
    front_end::FrontEnd,
    hir::{ExprId, ExprKind, Module, StmtKind},
    preamble::Preamble,
    source::PassSource,
    stages::Link,
    types::{Scalar, Type},
};
use eddy_diag::{SourceId, Span};

/// A value that Image draws instead of its picture; a buffer draws it into a second target, next to its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Probe {
    pub source: SourceId,
    /// A byte offset in the text: the innermost expression there is probed; at the name in a declaration, the initial
    /// value of the variable.
    pub at: u32,
    /// The number of times that the value is computed, per pixel, before the one that is drawn.
    pub visit: u32,
}

/// The expression that is probed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProbedExpression {
    pub span: Span,
    /// As GLSL writes it.
    pub type_text: String,
    /// The number of components of the value that are drawn, 1 to 4.
    pub components: u8,
    /// The components are ints, uints or bools.
    pub is_whole: bool,
}

/// Returns what a probe shows in a text without errors; `None` if there is no value.
pub fn probed(source: &PassSource<'_>, preamble: Option<&Preamble>, probe: &Probe) -> Option<ProbedExpression> {
    let pass = FrontEnd::run(source, &Link::default(), preamble);
    let (expr, span) = find(&pass.module, &pass.origins, probe)?;
    let (module, ty) = (&pass.module, pass.module[expr].ty);
    if matches!(module.types.get(ty), Type::Void | Type::Error | Type::Sampler { .. }) {
        return None;
    }
    let scalar = module.types.scalar(ty);
    Some(ProbedExpression {
        span,
        type_text: module.type_text(&pass.names, ty),
        components: module.types.components(ty).map_or(4, |count| count.min(4) as u8),
        is_whole: scalar.is_some_and(|scalar| scalar != Scalar::Float),
    })
}

/// Returns for each of these spans a byte offset at which a probe shows the expression there, and the number of
/// components of its value; `None` if no probe can distinguish it from another expression.
pub fn probe_places(source: &PassSource<'_>, preamble: Option<&Preamble>, spans: &[Span]) -> Vec<Option<(u32, usize)>> {
    let pass = FrontEnd::run(source, &Link::default(), preamble);
    places(&pass.module, &pass.origins, spans)
}

/// Returns the expression that a probe shows, and its span.
pub(super) fn find(module: &Module, origins: &Origins, probe: &Probe) -> Option<(ExprId, Span)> {
    Places::new(module, origins).find(module, origins, probe)
}

/// Returns for each of these spans a byte offset at which a probe shows the only expression there, and the number of
/// components of its value; `None` if there is no such expression or several, as in a macro expansion. The value of
/// `++` and `--` is not what they leave in the variable.
fn places(module: &Module, origins: &Origins, spans: &[Span]) -> Vec<Option<(u32, usize)>> {
    let places = Places::new(module, origins);
    let place = |span: &Span| {
        let mut there = places.exprs.iter().filter(|(_, other)| other == span);
        let (&(expr, _), None) = (there.next()?, there.next()) else { return None };
        if matches!(module[expr].kind, ExprKind::IncDec { .. } | ExprKind::Literal(_)) {
            return None;
        }
        let components = module.types.components(module[expr].ty)? as usize;
        let is_meant = |at: &u32| {
            let probe = Probe { source: span.source, at: *at, visit: 0 };
            places.find(module, origins, &probe).is_some_and(|(found, _)| found == expr)
        };
        Some(((span.start..=span.end).find(is_meant)?, components))
    };
    spans.iter().map(place).collect()
}

/// The spans of the expressions of a module that have a value.
struct Places {
    exprs: Vec<(ExprId, Span)>,
}

impl Places {
    fn new(module: &Module, origins: &Origins) -> Self {
        let mut places = vec![false; module.exprs.len()];
        for expr in &module.exprs {
            // The target of an assignment is a place; its value is that of the assignment.
            if let ExprKind::Assign { place, .. } | ExprKind::AssignOp { place, .. } | ExprKind::IncDec { place, .. } =
                expr.kind
            {
                places[place.index()] = true;
            }
        }
        let values = module.exprs.iter().enumerate().filter(|(index, _)| !places[*index]);
        Self { exprs: values.map(|(index, expr)| (ExprId::new(index), origins.span(expr.loc))).collect() }
    }

    fn find(&self, module: &Module, origins: &Origins, probe: &Probe) -> Option<(ExprId, Span)> {
        let covers = |span: &Span| span.source == probe.source && (span.start..=span.end).contains(&probe.at);
        let mut best: Option<(ExprId, Span)> = None;
        let mut offer = |id: ExprId, span: Span| {
            let is_better = best.is_none_or(|(_, other)| span.end - span.start < other.end - other.start);
            if is_better {
                best = Some((id, span));
            }
        };
        self.exprs.iter().filter(|(_, span)| covers(span)).for_each(|&(id, span)| offer(id, span));
        for stmt in &module.stmts {
            if let StmtKind::Declare { local, init: Some(init) } = stmt.kind
                && let Some(name) = module[local].name
                && covers(&origins.token_span(name.token))
            {
                offer(init, origins.token_span(name.token));
            }
        }
        best.map(|(id, span)| {
            (id, if module[id].loc == Default::default() { span } else { origins.span(module[id].loc) })
        })
    }
}
