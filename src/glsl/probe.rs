//! A probe: the expression at a place of the text, and the meaning of its picture.

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

/// A value that Image draws instead of its picture, and a buffer beside its own, into its second target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Probe {
    pub source: SourceId,
    /// A byte of the text: the innermost expression there is meant; at the name of a variable that is declared, its
    /// first value.
    pub at: u32,
    /// The value when it is computed for the time after so many, counted for each pixel.
    pub visit: u32,
}

/// The expression that is probed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProbedExpression {
    pub span: Span,
    /// As GLSL writes it.
    pub type_text: String,
    /// Numbers of the value that are drawn, 1 to 4.
    pub components: u8,
    /// They are ints, uints or bools.
    pub is_whole: bool,
}

/// Says what a probe means in a text without errors; `None` where there is no value.
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

/// Returns for each of these parts of the texts a byte at which a probe means the expression there, and how many numbers
/// its value has; `None` where no probe can tell it from another.
pub fn probe_places(source: &PassSource<'_>, preamble: Option<&Preamble>, spans: &[Span]) -> Vec<Option<(u32, usize)>> {
    let pass = FrontEnd::run(source, &Link::default(), preamble);
    places(&pass.module, &pass.origins, spans)
}

/// The expression that a probe means, and its part of the text.
pub(super) fn find(module: &Module, origins: &Origins, probe: &Probe) -> Option<(ExprId, Span)> {
    Places::new(module, origins).find(module, origins, probe)
}

/// A byte for each of these parts of the texts at which a probe means the one expression that stands there, and how many
/// numbers its value has; `None` where there is no such expression or several, as in what a macro brings in. What `++`
/// and `--` leave in a variable is not their value.
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

/// The places of the expressions of a module that have a value.
struct Places {
    exprs: Vec<(ExprId, Span)>,
}

impl Places {
    fn new(module: &Module, origins: &Origins) -> Self {
        let mut places = vec![false; module.exprs.len()];
        for expr in &module.exprs {
            // What is assigned to is a place; its value is that of the assignment.
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
