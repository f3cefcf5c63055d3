//! Any text, any position: an answer, and no panic.

use super::Marked;
use crate::services::Analysis;

/// Calls every service at every position of both texts.
fn ask_all(m: &Marked) {
    let analysis: Analysis = m.analysis();
    for (source, text) in [(super::COMMON, &m.common), (super::CODE, &m.code)] {
        analysis.classes(source);
        let symbols = analysis.outline(source);
        assert!(symbols.iter().all(|one| text.get(one.place.clone()) == Some(one.name.as_str())), "{text}");
        assert!(analysis.folds(source).iter().all(|fold| text.get(fold.range.clone()).is_some()), "{text}");
        assert!(analysis.hints(source, 0..text.len()).iter().all(|hint| text.is_char_boundary(hint.at)), "{text}");
        for at in 0..=text.len() + 2 {
            analysis.hover(source, at);
            analysis.near(source, at);
            let declared = analysis.definition(source, at);
            let uses = analysis.uses(source, at);
            assert!(declared.is_none_or(|span| uses.contains(&span) || !uses.is_empty()), "{at} in {text}");
            let found = analysis.completions(source, at);
            if text.is_char_boundary(at) && at <= text.len() {
                found.matching(&text[found.replace.clone()]);
            }
            analysis.signature_help(source, at);
        }
    }
}

const WHOLE: &str = "#define R iResolution\n#define F(a, b) (a + b)\nstruct S { vec3 p; float d[2]; };\nfloat g(in vec3 p, inout float t);\nfloat g(in vec3 p, inout float t) { t += p.x; return F(t, R.x); }\n#if 0\nleft out\n#else\nvoid mainImage(out vec4 o, in vec2 u) {\n  S s = S(vec3(u, 1.), float[2](1., 2.)); float t = 0.;\n  for (int i = 0; i < 2; i++) { t += s.d[i]; /* c */ }\n  o = vec4(g(s.p.zyx, t), texture(iChannel0, u / R.xy).rgb);\n}\n#endif\n";

#[test]
fn services_accept_every_position() {
    ask_all(&Marked::new("const float K = 1.; // é\n", &format!("@{WHOLE}")));
}

#[test]
fn truncated_text_does_not_panic() {
    for end in (0..WHOLE.len()).step_by(7) {
        ask_all(&Marked::new("#define X", &format!("{}@", &WHOLE[..end])));
    }
}

#[test]
fn malformed_text_does_not_panic() {
    for code in [
        "@",
        "\u{feff}@",
        "(@",
        "}@",
        ".@",
        "a.@.b",
        "#@",
        "#define",
        "#define F(",
        "#define F(a) F(a)\nF(F(1).@",
        "#define A B.\n#define B A.\nA.@",
        "f(f(f(f(@",
        "a[a[a[@",
        "1. .x.@",
        "1.5\n.xy.@z",
        "vec2.x.@",
        "true.x.@",
        "/*@",
        "//@",
        "\"@\"",
        "é.@x",
        "x\\\n.@y",
        "#if\n@",
        "#if 1\n#else\n@",
        "struct S { S s; } s; s.@s.s",
        "float f(float",
        "void f(a b c) {@",
        "vec3(vec3(vec3(.@",
        "iCh0.@.x",
        "gl_DepthRange.near@",
        "#define mainImage(o, u) vec2 p = 1 / u; o /= @",
    ] {
        let code = if code.contains('@') { code.to_owned() } else { format!("{code}@") };
        ask_all(&Marked::code(&code));
    }
    ask_all(&Marked::code(&format!("{}@", "(".repeat(500))));
    ask_all(&Marked::code(&format!("void f() {{ {}x@", "(".repeat(300))));
}
