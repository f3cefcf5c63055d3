//! The author's own uniforms in shaders: their scope in passes, and the uniform block of their values.

use eddy_diag::{Diagnostic, SourceId};
use eddy_glsl::{self as glsl, CustomUniformKind, UniformValue, UntypedValue, interface::CUSTOM_UNIFORM_BYTES};
use eddy_project::{
    CustomUniform, CustomUniformType, CustomUniformValue, CustomUniformValues, CustomUniforms, Dialect, IncludeLines,
    Project,
};

/// The slots in 64 KiB, the size of a uniform buffer that every device supports.
const MAX_CUSTOM_UNIFORMS: usize = (64 << 10) / CUSTOM_UNIFORM_BYTES as usize;

/// Returns the uniforms that the texts of a project declare, with errors for reserved names and for conditions that use
/// unknown names.
pub(super) fn custom_uniforms(project: &Project) -> CustomUniforms {
    let mut custom_uniforms = project.custom_uniforms();
    for custom_uniform in &custom_uniforms.list {
        if let Some(why) = taken(project.dialect, &custom_uniform.name) {
            custom_uniforms.diagnostics.push(
                Diagnostic::error(
                    custom_uniform.span,
                    format!("a uniform cannot be named `{}`: {why}", custom_uniform.name),
                )
                .hint("choose another name"),
            );
        }
    }
    if let Some(custom_uniform) = custom_uniforms.list.get(MAX_CUSTOM_UNIFORMS) {
        custom_uniforms.diagnostics.push(
            Diagnostic::error(
                custom_uniform.span,
                format!("a project can declare at most {MAX_CUSTOM_UNIFORMS} uniforms"),
            )
            .hint(
                "this is the limit of a uniform buffer on every device; move some values to an image file or a \
                   buffer",
            ),
        );
    }
    let conditions = project.check_conditions(&custom_uniforms);
    custom_uniforms.diagnostics.extend(conditions);
    custom_uniforms
}

/// Returns the reason that a uniform cannot have a name. A program with `void main()` has none of Shadertoy's names, and
/// its uniforms hide functions of the language, as any declaration does.
fn taken(dialect: Dialect, name: &str) -> Option<&'static str> {
    if dialect.has_main() { glsl::keyword_in_any_version(name) } else { glsl::taken(name) }
}

/// Returns those in the scope of a pass's texts: its own, Common's, and those of included files. `None`: Common alone.
pub(super) fn in_scope<'k>(
    (dialect, custom_uniforms): (Dialect, &'k CustomUniforms),
    lines: &IncludeLines,
    pass: Option<SourceId>,
) -> Vec<glsl::CustomUniform<'k>> {
    let mut texts = lines.reach(Project::COMMON_ID);
    texts.extend(pass.map(|id| lines.reach(id)).unwrap_or_default());
    let is_there = |custom_uniform: &CustomUniform| custom_uniform.declared_in.iter().any(|id| texts.contains(id));
    custom_uniforms
        .list
        .iter()
        .enumerate()
        .take(MAX_CUSTOM_UNIFORMS)
        .filter(|(_, custom_uniform)| is_there(custom_uniform) && taken(dialect, &custom_uniform.name).is_none())
        .map(|(slot, custom_uniform)| glsl::CustomUniform {
            is_declared: custom_uniform.is_declared,
            ..glsl::CustomUniform::new(&custom_uniform.name, kind(custom_uniform.ty), slot as u16)
        })
        .collect()
}

/// Returns the values of uniforms that the texts declare in plain GLSL: all except those of custom uniforms.
pub(super) fn uniform_values(custom_uniforms: &CustomUniforms, values: &CustomUniformValues) -> Vec<UniformValue> {
    let others = values.iter().filter(|(name, _)| custom_uniforms.get(name).is_none());
    others.map(|(name, value)| UniformValue { name: name.clone(), value: untyped(value) }).collect()
}

fn untyped(value: &CustomUniformValue) -> UntypedValue {
    match value {
        CustomUniformValue::Bool(on) => UntypedValue::Bool(*on),
        CustomUniformValue::Int(n) => UntypedValue::Number(f64::from(*n)),
        CustomUniformValue::Float(x) => UntypedValue::Number(*x),
        CustomUniformValue::Vector(all) => UntypedValue::List(all.iter().copied().map(UntypedValue::Number).collect()),
        CustomUniformValue::List(all) => UntypedValue::List(all.iter().map(untyped).collect()),
    }
}

pub(super) fn kind(ty: CustomUniformType) -> CustomUniformKind {
    match ty {
        CustomUniformType::Bool => CustomUniformKind::Bool,
        CustomUniformType::Int => CustomUniformKind::Int,
        CustomUniformType::Float => CustomUniformKind::Float,
        CustomUniformType::Vec2 => CustomUniformKind::Vec2,
        CustomUniformType::Vec3 | CustomUniformType::Color3 => CustomUniformKind::Vec3,
        CustomUniformType::Vec4 => CustomUniformKind::Vec4,
    }
}

/// Returns the slots of the block for custom uniforms with these values.
pub(super) fn block(custom_uniforms: &[CustomUniform], values: &CustomUniformValues) -> Vec<[u32; 4]> {
    let slot = |custom_uniform: &CustomUniform| {
        let mut words = [0; 4];
        match custom_uniform.value(values) {
            CustomUniformValue::Bool(on) => words[0] = u32::from(on),
            CustomUniformValue::Int(n) => words[0] = n as u32,
            CustomUniformValue::Float(x) => words[0] = (x as f32).to_bits(),
            CustomUniformValue::List(_) => unreachable!("a uniform's value has the uniform's type"),
            CustomUniformValue::Vector(all) => {
                for (word, x) in words.iter_mut().zip(all) {
                    *word = (x as f32).to_bits();
                }
            }
        }
        words
    };
    custom_uniforms.iter().map(slot).collect()
}
