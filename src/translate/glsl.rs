//! A replacement of `mix` on integers, which GLSL before 4.5 and ES 3.1 lacks (section 8.3 of the specifications).

use eddy_glsl::naga;
use naga::{
    Expression, Function, Module, ScalarKind, TypeInner,
    valid::{FunctionInfo, ModuleInfo},
};

/// The function that is called instead.
const NAME: &str = "eddy_mix";

/// Returns whether a module selects among the components of two vectors of integers or booleans.
pub(crate) fn selects_integers(module: &Module, info: &ModuleInfo) -> bool {
    let selects = |function: &Function, info: &FunctionInfo| {
        let is_vector = |e: naga::Handle<Expression>| match info[e].ty.inner_with(&module.types) {
            TypeInner::Vector { scalar, .. } => scalar.kind != ScalarKind::Float,
            _ => false,
        };
        function.expressions.iter().any(|(_, e)| matches!(e, Expression::Select { accept, .. } if is_vector(*accept)))
    };
    let entries = module.entry_points.iter().enumerate();
    module.functions.iter().any(|(handle, function)| selects(function, &info[handle]))
        || entries.map(|(n, e)| (&e.function, info.get_entry_point(n))).any(|(f, info)| selects(f, info))
}

/// Returns the text with a function for each type that `mix` is called with.
pub(crate) fn with_integer_mix(text: &str) -> String {
    let is_header = |line: &str| line.starts_with('#') || line.starts_with("precision ") || line.trim().is_empty();
    let header: usize = text.split_inclusive('\n').take_while(|line| is_header(line)).map(str::len).sum();
    let (header, body) = text.split_at(header);
    let mut out = header.to_owned();
    out.push_str(&overload("float", "float", "mix(a, b, t)"));
    for size in 2..=4 {
        let (float, bool) = (format!("vec{size}"), format!("bvec{size}"));
        for t in [&*float, "float", &bool] {
            out.push_str(&overload(&float, t, "mix(a, b, t)"));
        }
        for ty in ["ivec", "uvec", "bvec"].map(|ty| format!("{ty}{size}")) {
            let parts: Vec<String> = "xyzw".chars().take(size).map(|c| format!("t.{c} ? b.{c} : a.{c}")).collect();
            out.push_str(&overload(&ty, &bool, &format!("{ty}({})", parts.join(", "))));
        }
    }
    let mut before = ' ';
    let mut rest = body;
    while let Some(at) = rest.find("mix(") {
        before = rest[..at].chars().next_back().unwrap_or(before);
        out.push_str(&rest[..at]);
        let is_name = !before.is_alphanumeric() && before != '_';
        out.push_str(if is_name { NAME } else { "mix" });
        out.push('(');
        before = '(';
        rest = &rest[at + "mix(".len()..];
    }
    out + rest
}

fn overload(ty: &str, t: &str, value: &str) -> String {
    format!("{ty} {NAME}({ty} a, {ty} b, {t} t) {{ return {value}; }}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_names_of_calls_are_renamed() {
        let out = with_integer_mix("#version 300 es\n\nprecision highp int;\n\nint a = mix(mix(b, c), remix(d));\n");
        assert!(out.starts_with("#version 300 es\n\nprecision highp int;\n\nfloat eddy_mix(float a"), "{out}");
        assert!(out.ends_with("int a = eddy_mix(eddy_mix(b, c), remix(d));\n"), "{out}");
        assert!(
            out.contains(
                "ivec2 eddy_mix(ivec2 a, ivec2 b, bvec2 t) { return ivec2(t.x ? b.x : a.x, t.y ? b.y : a.y); }"
            )
        );
    }
}
