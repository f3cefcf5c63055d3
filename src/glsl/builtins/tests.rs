//! The table itself: every row is complete, and all its readers need the row alone.

use super::{constant::Constant, *};
use crate::{Dialect, PassSource, Version, compile, services::Analysis, source::PassKind};
use eddy_diag::{Diagnostic, SourceId};
use std::collections::BTreeSet;

/// Returns a type that fits a pattern, of three components where it can have several.
fn type_text(overload: &Overload, pattern: Pattern) -> String {
    match pattern {
        Pattern::Matrix | Pattern::Square | Pattern::Transposed => "mat3".to_owned(),
        _ => overload.shown(pattern, 3),
    }
}

/// Returns a plain shader that calls an overload, with constant or non-constant arguments.
fn shader(builtin: Builtin, overload: &Overload, is_constant: bool) -> String {
    let result = type_text(overload, overload.result);
    let count = overload.params.len();
    let is_constant_argument = |i| [builtin.offset_argument(), builtin.component_argument(count)].contains(&Some(i));
    let (mut uniforms, mut locals, mut args) = (String::new(), String::new(), Vec::new());
    for (i, &pattern) in overload.params.iter().enumerate() {
        let ty = type_text(overload, pattern);
        if matches!(pattern, Pattern::Sampler(..)) {
            uniforms.push_str(&format!("uniform {ty} a{i};\n"));
        } else if is_constant || is_constant_argument(i) {
            locals.push_str(&format!("    const {ty} a{i} = {ty}({});\n", if ty == "uint" { "1u" } else { "1" }));
        } else {
            locals.push_str(&format!("    {ty} a{i};\n"));
        }
        args.push(format!("a{i}"));
    }
    let call = format!("{}({})", builtin.name, args.join(", "));
    let storage = if is_constant { "const " } else { "" };
    let call = if result == "void" { call } else { format!("{storage}{result} r = {call}") };
    format!(
        "#version 300 es\nprecision highp float;\nprecision highp sampler3D;\nprecision highp sampler2DArray;\n\
         precision highp sampler2DShadow;\nprecision highp samplerCubeShadow;\nprecision highp sampler2DArrayShadow;\n\
         {uniforms}out vec4 c;\nvoid main() {{\n{locals}    {call};\n    c = vec4(1);\n}}\n"
    )
}

/// Returns a dialect that has a function.
fn dialect(builtin: Builtin) -> Dialect {
    match builtin.since {
        0 => Dialect::Shadertoy,
        number => Dialect::Any(Version { number, is_es: false }),
    }
}

#[test]
fn every_row_has_a_description() {
    let names: BTreeSet<&str> = Builtin::all().map(|builtin| builtin.row().name).collect();
    assert_eq!(names.len(), Builtin::COUNT, "a name occurs twice");
    for builtin in Builtin::all() {
        let name = builtin.name;
        assert!(builtin.text.ends_with('.') && builtin.text.len() > 12, "{name}: {:?}", builtin.text);
        for overload in builtin.overloads {
            let count = overload.params.len();
            let names: BTreeSet<&str> = (0..count).map(|i| builtin.param(i, count)).collect();
            assert_eq!(names.len(), count, "{name}: {names:?}");
            assert!(!names.contains(""), "{name} takes {count}, named are {}", builtin.params);
        }
        let max_params = builtin.overloads.iter().map(|o| o.params.len()).max();
        assert_eq!(Some(builtin.params.split(", ").count()), max_params, "{name} has a name too many");
        for gap in builtin.undefined_for {
            assert!(gap.what.contains("(8.") && gap.decides.end <= builtin.params.split(", ").count(), "{gap:?}");
        }
    }
}

#[test]
fn compiler_and_editor_need_the_row_alone() {
    for builtin in Builtin::all().filter(|builtin| !builtin.is_of_image) {
        let overloads: Vec<&Overload> = builtin.overloads.iter().filter(|o| !o.is_one_dimensional()).collect();
        for overload in &overloads {
            let text = shader(builtin, overload, false);
            let source = PassSource { dialect: dialect(builtin), ..PassSource::fragment(&text) };
            // WebGPU compares depths only in the first level.
            let has_none = |found: &Diagnostic| found.message.contains("WebGPU");
            if let Err(found) = compile(&source) {
                assert!(found.iter().any(has_none), "{text}{found:?}");
            }
            let (analysis, call) = (Analysis::new(&source), format!(" {}(", builtin.name));
            let at = text.find(&call).expect("it is called") + 1;
            let proposed = analysis.completions(SourceId(0), at + 1).items;
            assert!(proposed.iter().any(|item| item.label == builtin.name), "{text}");
            let hover = analysis.hover(SourceId(0), at).expect("it is known");
            assert_eq!((hover.kind, hover.doc.as_str()), ("built-in function", builtin.text), "{text}");
            let help = analysis.signature_help(SourceId(0), text.find(&call).unwrap() + call.len());
            assert_eq!(help.expect("it is a call").signatures.len(), overloads.len(), "{text}");
        }
    }
    let image = PassSource::image("void mainImage(out vec4 c, vec2 p) { st_assert(p.x > 1.0, 2); c = vec4(1); }");
    assert!(compile(&image).is_ok() && image.kind == PassKind::Image);
}

#[test]
fn functions_of_constants_are_constants() {
    for builtin in Builtin::all().filter(|builtin| !matches!(builtin.constant, Constant::None)) {
        for overload in builtin.overloads {
            let text = shader(builtin, overload, true);
            let source = PassSource { dialect: dialect(builtin), ..PassSource::fragment(&text) };
            assert!(compile(&source).is_ok(), "{text}");
        }
    }
}
