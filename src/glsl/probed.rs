//! The meaning of a probe's picture, for who shows it.

use super::{
    check, parse,
    probe::{self, Probe, find},
    source::PassSource,
    types::{Scalar, Type},
};
use eddy_diag::Span;

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
pub fn probed(source: &PassSource<'_>, probe: &Probe) -> Option<ProbedExpression> {
    let parsed = parse::parse(source, None);
    let checked = check::check(&parsed.ast, &parsed.origins, &parsed.names, source, None);
    let (expr, span) = find(&checked.module, &parsed.origins, probe)?;
    let (module, ty) = (&checked.module, checked.module[expr].ty);
    if matches!(module.types.get(ty), Type::Void | Type::Error | Type::Sampler { .. }) {
        return None;
    }
    let scalar = module.types.scalar(ty);
    Some(ProbedExpression {
        span,
        type_text: module.type_text(&parsed.names, ty),
        components: module.types.components(ty).map_or(4, |count| count.min(4) as u8),
        is_whole: scalar.is_some_and(|scalar| scalar != Scalar::Float),
    })
}

/// Returns for each of these parts of the texts a byte at which a probe means the expression there, and how many numbers
/// its value has; `None` where no probe can tell it from another.
pub fn probe_places(source: &PassSource<'_>, spans: &[Span]) -> Vec<Option<(u32, usize)>> {
    let parsed = parse::parse(source, None);
    let checked = check::check(&parsed.ast, &parsed.origins, &parsed.names, source, None);
    probe::places(&checked.module, &parsed.origins, spans)
}
