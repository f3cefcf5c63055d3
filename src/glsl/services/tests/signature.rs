//! Signature help: which call, which overload, which argument.

use super::Marked;

/// Returns the active signature with the active parameter in brackets, or nothing.
fn help(code: &str) -> String {
    let m = Marked::code(code);
    let Some(help) = m.analysis().signature_help(m.at.0, m.at.1) else { return String::new() };
    let signature = &help.signatures[help.active];
    match signature.params.get(help.parameter) {
        Some(r) => {
            let label = &signature.label;
            format!("{}[{}]{}", &label[..r.start], &label[r.clone()], &label[r.end..])
        }
        None => signature.label.clone(),
    }
}

#[test]
fn argument_at_the_caret_is_found() {
    for (code, wanted) in [
        ("void f() { float y = clamp(@ }", "genType clamp([genType x], genType minVal, genType maxVal)"),
        (
            "void f() { float y = clamp(1., @\n float z = 2.; }",
            "genType clamp(genType x, [genType minVal], genType maxVal)",
        ),
        ("void f(vec3 p) { mix(p, p.yzx * 2., @); }", "genType mix(genType x, genType y, [genType a])"),
        ("void f() { vec4 c = texture(iChannel0, @ }", "gvec4 texture(gsampler2D sampler, [vec2 P])"),
        ("void f() { vec4 c = texture(iChannel1, @ }", "gvec4 texture(gsamplerCube sampler, [vec3 P])"),
        ("void f() { atan(@ }", "genType atan([genType y], genType x)"),
        (
            "float g(float a, inout vec2 b) { return a; }\nvoid f(vec2 q) { g(sin(1.), @q); }",
            "float g(float a, [inout vec2 b])",
        ),
        (
            "float g(float a, inout vec2 b) { return a; }\nvoid f(vec2 q) { g(sin(1.@), q); }",
            "genType sin([genType angle])",
        ),
        (
            "float g(float a) { return a; }\nfloat g(vec2 a, float b) { return b; }\nvoid f() { g(vec2(1), @ }",
            "float g(vec2 a, [float b])",
        ),
        ("#define M(u, v) u\nvoid f() { M(1, @) }", "M(u, [v])"),
        ("struct S { float a; vec3 b; };\nvoid f() { S s = S(1., @ }", "S(float a, [vec3 b])"),
        ("void f() { vec3 v = vec3(1., @ }", "vec3(x, [y], z)"),
        ("void f() { pow((1. + @ }", "genType pow([genType x], genType y)"),
        ("void f(float a[3]) { pow(a[1], a[@ }", "genType pow(genType x, [genType y])"),
        ("void f() { for (int i = 0; i < int(max(1., @); i++) {} }", "genType max(genType x, [genType y])"),
        // Too many arguments: no parameter is marked.
        ("void f() { sin(1., @); }", "genType sin(genType angle)"),
        ("void f() { sin(1.)@; }", ""),
        ("void f(float a@) { }", ""),
        ("void f() { if (@true) { } }", ""),
        ("void f() { float y = (1. + @2.); }", ""),
        ("void f() { sin(1.); @ }", ""),
        ("void f() { nobody(@ }", ""),
        ("void f() { // sin(@\n}", ""),
    ] {
        assert_eq!(help(code), wanted, "{code}");
    }
}

#[test]
fn all_overloads_are_listed_with_a_description() {
    let m = Marked::code(
        "// Distance to a ball.\nfloat ball(vec3 p) { return 1.; }\nfloat ball(vec3 p, float r) { return r; }\nvoid f() { ball(@ }",
    );
    let help = m.analysis().signature_help(m.at.0, m.at.1).unwrap();
    assert_eq!(help.signatures.len(), 2);
    assert_eq!(help.doc, "Distance to a ball.");
    assert!(m.code[help.name_start..].starts_with("ball("));
}
