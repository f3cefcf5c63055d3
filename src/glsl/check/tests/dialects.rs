//! Texts for other programs: the extensions of GLSL ES 3.00 they may use, and the names they may not.

use crate::{Dialect, PassKind, PassSource, Text, Version, compile, diagnose};
use eddy_diag::SourceId;

/// The dialect of an ISF file without a `#version` line.
const ISF: Dialect = Dialect::Any(Version { number: 120, is_es: false });

pub(super) fn source(dialect: Dialect, text: &str) -> PassSource<'_> {
    PassSource { dialect, ..PassSource::new(PassKind::Image, Text { id: SourceId(0), text }) }
}

pub(super) fn errors(dialect: Dialect, text: &str) -> Vec<String> {
    let said = diagnose(&source(dialect, text));
    said.into_iter().filter(|d| d.is_error()).map(|d| d.message).collect()
}

pub(super) fn body(statements: &str) -> String {
    format!("float half_of(float x) {{ return x / 2; }}\nvoid mainImage(out vec4 c, in vec2 p) {{ {statements} }}\n")
}

/// Statements that are valid in GLSL 4.30 (sections 4.1.10, 5.4 and 6.1) but not in GLSL ES 3.00.
const CONVERTED: [&str; 13] = [
    "float x = 1; c = vec4(x);",
    "c = vec4(2 * p, p + 1);",
    "c = vec4(0); c *= 2; c.x += 1;",
    "float x = p.x > 1 ? 1 : 0.5; c = vec4(x);",
    "c = vec4(half_of(3));",
    "c = vec4(max(p.x, 0), mod(p.y, 2), mix(0, 1.0, p.x), pow(2, p.x));",
    "c = clamp(vec4(p, p), 0, 1);",
    "uint n = 3; n += 2; c = vec4(n);",
    "uint n = 3u; float x = n; c = vec4(x) * n;",
    "ivec2 i = ivec2(p); vec2 v = i; c = vec4(v, i * 0.5);",
    "bool is = p.x == 1; c = vec4(is);",
    "float a[2] = float[2](1, 2); c = vec4(a[0], a[1], 0, 1);",
    "c = vec4(p, 0, 1); for (float i = 0; i < 3; i++) c.z += i;",
];

#[test]
fn numbers_are_converted_implicitly() {
    for statements in CONVERTED {
        let text = body(statements);
        assert!(!errors(Dialect::Shadertoy, &text).is_empty(), "{statements}");
        for dialect in [Dialect::Ghostty, ISF] {
            assert_eq!(errors(dialect, &text), [""; 0], "{statements}");
            compile(&source(dialect, &text)).unwrap_or_else(|found| panic!("{statements}: {found:?}"));
        }
    }
}

#[test]
fn narrowing_conversions_are_rejected() {
    for statements in [
        "int i = 1.0; c = vec4(i);",
        "int i = 2u; c = vec4(i);",
        "bool b = 1; c = vec4(b);",
        "vec2 v = 1; c = vec4(v, v);",
        "int i = 1; i *= 0.5; c = vec4(i);",
        "float x = true; c = vec4(x);",
    ] {
        assert!(!errors(Dialect::Ghostty, &body(statements)).is_empty(), "{statements}");
    }
    // `inout` arguments are not converted.
    let text = "void f(inout float x) { x = 1; }\nvoid mainImage(out vec4 c, in vec2 p) { int i; f(i); c = vec4(i); }";
    assert!(!errors(Dialect::Ghostty, text).is_empty());
}

#[test]
fn the_overload_with_the_fewest_conversions_is_called() {
    let text = "int f(int a, int b) { return 1; }\nfloat f(float a, float b) { return 2; }\n\
                void mainImage(out vec4 c, in vec2 p) { int exact = f(1, 2); float other = f(1, 2.0); c = vec4(exact, other, 0, 1); }";
    assert_eq!(errors(Dialect::Ghostty, text), [""; 0]);
    let wrong = text.replace("int exact = f(1, 2)", "int exact = f(1, 2.0)");
    assert_eq!(errors(Dialect::Ghostty, &wrong).len(), 1);
}

#[test]
fn lists_in_braces_are_constructors() {
    for statements in [
        "float a[3] = {1, 2, 3.5}; c = vec4(a[0], a[1], a[2], 1);",
        "const vec2 a[] = { {1, 2}, vec2(3.0), {4, 5}, }; c = vec4(a[0], a[2]);",
        "vec4 v = {p.x, p.y, 0, 1}; c = v;",
    ] {
        let text = body(statements);
        assert_eq!(errors(Dialect::Ghostty, &text), [""; 0], "{statements}");
        assert!(errors(Dialect::Shadertoy, &text).iter().any(|e| e.contains("lists in braces")), "{statements}");
    }
    let text = "struct S { vec2 at; int n; };\nconst S ALL[2] = { {{1, 2}, 3}, {{4, 5}, 6} };\n\
                void mainImage(out vec4 c, in vec2 p) { c = vec4(0); }";
    assert_eq!(errors(Dialect::Ghostty, text), [""; 0]);
    for wrong in
        ["float a[3] = {1, 2}; c = vec4(a[0]);", "float x = {}; c = vec4(x);", "float a[2] = {1, 2; c = vec4(a[0]);"]
    {
        assert!(!errors(Dialect::Ghostty, &body(wrong)).is_empty(), "{wrong}");
    }
}

#[test]
fn non_constant_global_initialisers_are_accepted() {
    let text = "float at = sin(iTime) + iResolution.x;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(at); }";
    assert_eq!(errors(ISF, text), [""; 0]);
    compile(&source(ISF, text)).unwrap();
    assert_eq!(errors(Dialect::Shadertoy, text).len(), 1);
}

#[test]
fn ghostty_has_one_channel_and_no_author_uniforms() {
    let texture = |n: u32| body(&format!("c = texture(iChannel{n}, p / iResolution.xy);"));
    assert_eq!(errors(Dialect::Ghostty, &texture(0)), [""; 0]);
    assert_eq!(errors(Dialect::Ghostty, &texture(1)).len(), 1);
    assert_eq!(errors(Dialect::Shadertoy, &texture(1).replace("/ 2;", "/ 2.0;")), [""; 0]);
    let own = "uniform float strength;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(strength); }";
    assert_eq!(errors(Dialect::Ghostty, own).len(), 1);
    for statements in ["c = vec4(iGlobalTime);", "c = vec4(iCh0.time);", "st_assert(true); c = vec4(0);"] {
        assert!(!errors(Dialect::Ghostty, &body(statements)).is_empty(), "{statements}");
    }
}

#[test]
fn version_macro_matches_the_language() {
    for (dialect, version) in [(Dialect::Shadertoy, 300), (Dialect::Ghostty, 430), (ISF, 120)] {
        let text = format!(
            "#if __VERSION__ != {version}\n#error other\n#endif\n{}",
            body("c = vec4(p, p);").replace("/ 2;", "/ 2.0;")
        );
        assert_eq!(errors(dialect, &text), [""; 0], "{version}");
    }
}

#[test]
fn variable_declared_in_both_stages_is_one_variable() {
    let text = "vec2 left;\nvoid before() { left = vec2(1.0); }\nvec2 left;\n\
                void mainImage(out vec4 c, in vec2 p) { before(); c = vec4(left.xy, 0.0, 1.0); }";
    assert_eq!(errors(ISF, text), [""; 0]);
    assert_eq!(errors(Dialect::Ghostty, text).len(), 1);
    assert_eq!(errors(ISF, &text.replacen("vec2 left;", "vec3 left;", 1)).len(), 2);
}

#[test]
fn builtin_functions_can_be_replaced() {
    let text = "float round(float x) { return floor(x + 0.5); }\nvec2 normalize(vec2 v, float most) { return v * most; }\n\
                int sign(vec2 a, vec2 b) { return 3; }\n\
                void mainImage(out vec4 c, in vec2 p) { float one = round(0.75); int three = sign(p, p); \
                c = vec4(one, three, sign(-2.0), normalize(p, 2.0).x); c.xyz = normalize(c.xyz) + round(c.xyz); }";
    assert_eq!(errors(Dialect::Shadertoy, text).iter().filter(|e| e.contains("cannot be declared again")).count(), 3);
    for dialect in [Dialect::Ghostty, ISF] {
        assert_eq!(errors(dialect, text), [""; 0]);
        let said = diagnose(&source(dialect, text));
        assert!(said.is_empty(), "{said:?}");
        compile(&source(dialect, text)).unwrap();
    }
}

#[test]
fn exact_builtin_overload_precedes_conversions() {
    // The built-in has an `int` overload, which is called although the text has one for `float`.
    let text = "vec2 max(float a, float b) { return vec2(a, b); }\n\
                void mainImage(out vec4 c, in vec2 p) { int of_ints = max(1, 2); vec2 own = max(1.0, 2.0); c = vec4(own, of_ints, 1); }";
    assert_eq!(errors(Dialect::Ghostty, text), [""; 0]);
}

#[test]
fn isf_shaders_can_redefine_shadertoy_uniforms() {
    let text = "vec2 size() { return iResolution.xy; }\nvec3 iResolution = vec3(size(), 1.0);\nconst float iTime = 2.0;\n\
                void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, iTime, 1.0); }";
    assert_eq!(errors(ISF, text), [""; 0]);
    compile(&source(ISF, text)).unwrap();
    let said = errors(Dialect::Ghostty, text);
    assert!(said.iter().any(|e| e == "`iResolution` is already declared by Ghostty's prefix"), "{said:?}");
}

#[test]
fn messages_name_the_host_program() {
    let said = |dialect| {
        errors(dialect, "#version 330\nvoid main() {}\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }")
            .join("\n")
    };
    for (dialect, header) in
        [(Dialect::Shadertoy, "Shadertoy's header"), (Dialect::Ghostty, "Ghostty's prefix"), (ISF, "the host's header")]
    {
        let said = said(dialect);
        // ISF ignores versions.
        let count = usize::from(dialect != ISF);
        assert_eq!(said.matches(header).count(), count, "{said}");
        assert_eq!(said.contains("Shadertoy"), dialect == Dialect::Shadertoy, "{said}");
    }
}

#[test]
fn version_and_extension_directives_follow_the_host() {
    let main = "void mainImage(out vec4 c, in vec2 p) { c = vec4(fwidth(p), 0.0, 1.0); }";
    let extension =
        |behaviour: &str| format!("float a = 1.0;\n#extension GL_OES_standard_derivatives : {behaviour}\n{main}");
    for text in [extension("enable"), extension("require"), format!("#version 150\n{main}")] {
        assert_eq!(errors(ISF, &text), [""; 0], "{text}");
        assert_eq!(errors(Dialect::Shadertoy, &text).len(), 1, "{text}");
    }
    assert_eq!(errors(Dialect::Ghostty, &extension("enable")), [""; 0]);
    let all = diagnose(&source(Dialect::Ghostty, &extension("enable")));
    assert!(all.iter().any(|d| d.message == "there is no extension `GL_OES_standard_derivatives`"), "{all:?}");
    assert_eq!(errors(Dialect::Ghostty, &extension("require")).len(), 1);
}
