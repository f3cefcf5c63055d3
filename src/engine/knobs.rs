//! The author's own uniforms on their way into shaders: which a pass may name, and the block their values lie in.

use crate::{
    diag::{Diagnostic, SourceId},
    glsl::{self, GivenValue, KnobKind, UniformValue, interface::KNOB_BYTES},
    project::{IncludeLines, Knob, KnobType, KnobValue, KnobValues, Knobs, Project},
};

/// Slots in the 64 KiB that a uniform buffer has on every device.
const MAX_KNOBS: usize = (64 << 10) / KNOB_BYTES as usize;

/// Returns the uniforms that the texts of a project declare, with errors for names that the language has taken.
pub(super) fn knobs(project: &Project) -> Knobs {
    let mut knobs = project.knobs();
    for knob in &knobs.list {
        if let Some(why) = glsl::taken(&knob.name) {
            knobs.diagnostics.push(
                Diagnostic::error(knob.span, format!("no uniform can be called `{}`: {why}", knob.name))
                    .hint("choose another name"),
            );
        }
    }
    if let Some(knob) = knobs.list.get(MAX_KNOBS) {
        knobs.diagnostics.push(
            Diagnostic::error(knob.span, format!("a project has at most {MAX_KNOBS} uniforms of its own")).hint(
                "that is what a uniform buffer holds on every device; put some of them into a picture or a buffer",
            ),
        );
    }
    knobs
}

/// Returns those that the texts of a pass may name: its own, Common's, and those of what they include. `None`: Common
/// alone.
pub(super) fn in_scope<'k>(knobs: &'k Knobs, lines: &IncludeLines, pass: Option<SourceId>) -> Vec<glsl::Knob<'k>> {
    let mut texts = lines.reach(Project::COMMON_ID);
    texts.extend(pass.map(|id| lines.reach(id)).unwrap_or_default());
    let is_there = |knob: &Knob| knob.declared_in.iter().any(|id| texts.contains(id));
    knobs
        .list
        .iter()
        .enumerate()
        .take(MAX_KNOBS)
        .filter(|(_, knob)| is_there(knob) && glsl::taken(&knob.name).is_none())
        .map(|(slot, knob)| glsl::Knob { name: &knob.name, kind: kind(knob.ty), slot: slot as u16 })
        .collect()
}

/// Returns the values for uniforms that the texts declare in GLSL's own way: those that are no knob's.
pub(super) fn given(knobs: &Knobs, values: &KnobValues) -> Vec<UniformValue> {
    let others = values.iter().filter(|(name, _)| knobs.get(name).is_none());
    others.map(|(name, value)| UniformValue { name: name.clone(), value: as_given(value) }).collect()
}

fn as_given(value: &KnobValue) -> GivenValue {
    match value {
        KnobValue::Bool(on) => GivenValue::Bool(*on),
        KnobValue::Int(n) => GivenValue::Number(f64::from(*n)),
        KnobValue::Float(x) => GivenValue::Number(*x),
        KnobValue::Vector(all) => GivenValue::List(all.iter().copied().map(GivenValue::Number).collect()),
        KnobValue::List(all) => GivenValue::List(all.iter().map(as_given).collect()),
    }
}

fn kind(ty: KnobType) -> KnobKind {
    match ty {
        KnobType::Bool => KnobKind::Bool,
        KnobType::Int => KnobKind::Int,
        KnobType::Float => KnobKind::Float,
        KnobType::Vec2 => KnobKind::Vec2,
        KnobType::Vec3 | KnobType::Color3 => KnobKind::Vec3,
        KnobType::Vec4 => KnobKind::Vec4,
    }
}

/// Returns the block's slots for knobs at these values.
pub(super) fn block(knobs: &[Knob], values: &KnobValues) -> Vec<[u32; 4]> {
    let slot = |knob: &Knob| {
        let mut words = [0; 4];
        match knob.value(values) {
            KnobValue::Bool(on) => words[0] = u32::from(on),
            KnobValue::Int(n) => words[0] = n as u32,
            KnobValue::Float(x) => words[0] = (x as f32).to_bits(),
            KnobValue::List(_) => unreachable!("a uniform's value has the uniform's type"),
            KnobValue::Vector(all) => {
                for (word, x) in words.iter_mut().zip(all) {
                    *word = (x as f32).to_bits();
                }
            }
        }
        words
    };
    knobs.iter().map(slot).collect()
}
