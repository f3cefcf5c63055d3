//! Hover, definition, uses, classes.

use super::{CODE, COMMON, Marked};
use crate::{
    CustomUniform, CustomUniformKind, PassKind, PassSource, Text,
    services::{Analysis, Class},
};
use eddy_diag::SourceId;

/// Returns the kind, first line of the signature and text for the marked name.
fn hover(m: &Marked) -> (&'static str, String, String) {
    let found = m.analysis().hover(m.at.0, m.at.1).unwrap_or_else(|| panic!("no hover in {:?}", m.code));
    (found.kind, found.signature.join("\n"), found.doc)
}

#[test]
fn hover_shows_what_a_name_is() {
    for (code, kind, signature, doc) in [
        ("#define mainImage@(o, u) o = vec4(1)", "macro", "#define mainImage(o, u) o = vec4(1)", ""),
        ("float f(vec3 p) { return p@.x; }", "parameter", "vec3 p", ""),
        ("void f(inout vec2 q) { q@ *= 2.; }", "parameter", "inout vec2 q", ""),
        ("const float K@ = 1.5 * 2.;", "global", "const float K = 3.0", ""),
        ("void f() { const ivec2 s = ivec2(3, 4); s@; }", "local constant", "const ivec2 s = ivec2(3, 4)", ""),
        (
            "// how far\n// it is\nfloat d@(vec2 p, float r) { return 1.; }",
            "function",
            "float d(vec2 p, float r)",
            "how far\nit is",
        ),
        ("float d(vec2 p) { return 1.; } // short\nvoid f() { d@(vec2(1)); }", "function", "float d(vec2 p)", "short"),
        ("struct S { float a; vec3 b; }; S@ s;", "struct", "struct S {\n    float a;\n    vec3 b;\n}", ""),
        ("struct S { float a; /* the size */ float b; }; void f(S s) { s.a@; }", "field", "float S.a", "the size"),
        ("#define PI 3.14\nfloat x = P@I;", "macro", "#define PI 3.14", ""),
        (
            "#define F(a, b) \\\n   ((a) + \\\n   (b))\nfloat x = @F(1., 2.);",
            "macro",
            "#define F(a, b) ((a) + (b))",
            "",
        ),
        (
            "void f() { vec3 v = normalize@(vec3(iTime)); }",
            "built-in function",
            "vec3 normalize(vec3 x)",
            "The vector of length 1 in the direction of x. Undefined for a vector of length 0.",
        ),
        (
            "void f() { float m = mi@n(iTime, 1.); }",
            "built-in function",
            "float min(float x, float y)\n// and 5 more overloads",
            "The smaller of the two, component by component. Either may come back where one is NaN.",
        ),
        (
            "void f() { iChannelResolution@[0]; }",
            "uniform",
            "uniform vec3 iChannelResolution[4]",
            "For each channel, its size in texels: width, height, depth (1 for 2D textures). (0, 0, 0) while \
             nothing is loaded.",
        ),
        ("void f() { texture(iChannel1@, vec3(1)); }", "channel", "uniform samplerCube iChannel1", ""),
        ("void f() { gl_FragCoord@; }", "built-in variable", "in vec4 gl_FragCoord", ""),
        ("void f() { vec3 p; p.x@y; }", "components", "vec2 .xy", "Components of a `vec3`."),
        (
            "void f() { discard@; }",
            "keyword",
            "",
            "Ends without writing the pixel. In a buffer, the pixel keeps its value from two frames ago.",
        ),
        ("#ifdef@ X\n#endif", "directive", "", "Compiles the lines up to `#endif` only if a macro is defined."),
        ("void mainImage@(out vec4 o, vec2 p) { }", "function", "void mainImage(out vec4 o, vec2 p)", ""),
        ("void f() { normalise@(vec3(1)); }", "unknown name", "", "Not declared here. Did you mean `normalize`?"),
        // Invalid texts.
        ("void f(vec3 p) { vec3 c = nor@malize(p }", "built-in function", "", ""),
        ("void f(vec3 pos) { float d = 1.; pos@. \n}", "parameter", "vec3 pos", ""),
        ("float g(float a) { return a; }\nvoid f() { if (x { g@(1.); \n", "function", "float g(float a)", ""),
        ("struct R { vec3 o; };\nvoid f(R r) { r.o@. }", "field", "vec3 R.o", ""),
    ] {
        let found = hover(&Marked::code(code));
        assert_eq!(found.0, kind, "{code}");
        if !signature.is_empty() {
            assert_eq!(found.1, signature, "{code}");
        }
        if !doc.is_empty() {
            assert_eq!(found.2, doc, "{code}");
        }
    }
}

#[test]
fn tokens_without_explanation_have_no_hover() {
    for code in [
        "float x = 1.@5;",
        "// a c@omment iTime",
        "#if 0\nfloat iTime@;\n#endif",
        "float x; @ ",
        "vec3@ p;",
        "qqqqqq@ x",
    ] {
        let m = Marked::code(code);
        assert_eq!(m.analysis().hover(m.at.0, m.at.1), None, "{code}");
    }
    let m = Marked::code("f@");
    assert_eq!(m.analysis().hover(eddy_diag::SourceId(7), 0), None);
    assert_eq!(m.analysis().hover(CODE, 999), None);
}

#[test]
fn definitions_are_found_in_both_texts() {
    for (common, code, place) in [
        ("const float K = 2.;", "float x = K@;", "const float [K] = 2.;"),
        ("#define PI 3.", "float x = @PI;", "#define [PI] 3."),
        ("float g(float a) { return a; }", "void f() { g@(1.); }", "float [g](float a) { return a; }"),
        ("", "void f() { float a; { float a; a@ = 1.; } }", "void f() { float a; { float [a]; a = 1.; } }"),
        ("", "void f() { float a; { float a; } a@ = 1.; }", "void f() { float [a]; { float a; } a = 1.; }"),
        ("", "float g(int);\nfloat g(int i) { return 1.; }\nvoid f() { g@(1); }", "float [g](int i) { return 1.; }"),
        ("", "float g(int);\nfloat g@(int i) { return 1.; }", "float [g](int);"),
        ("", "struct S { float a, b; };\nvoid f(S s) { s.b@; }", "struct S { float a, [b]; };"),
        (
            "",
            "float g(float a) { return a; }\nfloat g(vec2 a) { return a.x; }\nvoid f() { g@(vec2(1)); }",
            "float [g](vec2 a) { return a.x; }",
        ),
        // The statement at the mark is invalid: only its words are known.
        (
            "",
            "float g(float a) { return a; }\nfloat g(vec2 a) { return a.x; }\nvoid f(vec2 p) { float y = g@(p.yx) + ; }",
            "float [g](vec2 a) { return a.x; }",
        ),
        (
            "",
            "void f(float a) { float b = 1.;\n for (int i = 0; i < 3; i++) { float q = (b@ + ; } }",
            "void f(float a) { float [b] = 1.;",
        ),
        (
            "",
            "void f() { for (int i = 0; i < 3; i++) { i@ + + ; } }",
            "void f() { for (int [i] = 0; i < 3; i++) { i + + ; } }",
        ),
        ("struct S { vec3 d; };", "void f(S s) {\n s.d@. }", "struct S { vec3 [d]; };"),
    ] {
        let m = Marked::new(common, code);
        let found = m.analysis().definition(m.at.0, m.at.1).unwrap_or_else(|| panic!("{code}"));
        assert_eq!(m.shown(found), place, "{code}");
    }
    for code in [
        "void f() { si@n(1.); }",
        "float x = iT@ime;",
        "float x = nobody@;",
        "void f() { for (int i = 0; i < 3; i++) { } i@; }",
    ] {
        let m = Marked::code(code);
        assert_eq!(m.analysis().definition(m.at.0, m.at.1), None, "{code}");
    }
}

#[test]
fn uses_distinguish_items_of_the_same_name() {
    for (common, code, count) in [
        ("", "void f() { float a@ = 1.; { float a = 2.; a; } a; }", 2),
        ("", "void f() { float a = 1.; { float a = 2.; a@; } a; }", 2),
        ("", "float g(float a) { return a; }\nfloat g(vec2 a) { return a.x; }\nvoid f() { g(1.); g@(vec2(1)); }", 2),
        ("#define K 2.", "float x = K@ + K;\n#ifdef K\n#endif", 4),
        ("float g() { return 1.; }", "void f() { g@(); g(); }", 3),
        ("float g@() { return 1.; }", "void f() { g(); g(); }", 3),
        ("", "struct S { float a; };\nstruct T { float a; };\nvoid f(S s, T t) { s.a; t.a@; t.a; }", 3),
        // In a macro's text too, and in an invalid statement.
        ("", "float k@ = 1.;\n#define M k\nvoid f() { M; k; }", 3),
        ("", "void f() { float a@ = 1.; a; a + ; }", 3),
        ("", "void f() { sin@(1.); sin(2.); cos(1.); }", 2),
        ("", "void f() { iTime@; iTime; iFrame; }", 2),
        ("", "void f() { 1@.5; }", 0),
    ] {
        let m = Marked::new(common, code);
        let found = m.analysis().uses(m.at.0, m.at.1);
        let shown: Vec<String> = found.iter().map(|&span| m.shown(span)).collect();
        assert_eq!(found.len(), count, "{code}: {shown:#?}");
        let names: std::collections::BTreeSet<&str> = shown.iter().filter_map(|s| s.split(['[', ']']).nth(1)).collect();
        assert!(names.len() <= 1, "{code}: {names:?}");
    }
}

#[test]
fn uses_are_the_same_from_every_place() {
    let m = Marked::new(
        "float base(vec3 p) { return p.x; }\n",
        "@vec3 q;\nfloat twice(vec3 p) { return base(p) + base(p.zyx); }\nvoid mainImage(out vec4 o, vec2 u) { o = vec4(base(q), twice(q) }",
    );
    let analysis = m.analysis();
    let all = analysis.uses(COMMON, 7);
    assert_eq!(all.len(), 4);
    for &span in &all {
        assert_eq!(analysis.uses(span.source, span.start as usize), all);
        assert_eq!(analysis.uses(span.source, span.end as usize), all, "after the word");
    }
}

#[test]
fn words_are_classified_by_meaning() {
    use Class as C;
    let code = "@#define PI 3.\n#if 0\nold /* x */\n#else\nstruct S { float a; };\n#endif\nfloat g = PI;\nfloat fun(float par, S s) {\n  // note\n  float loc = sin(par) + s.a + iTime + 2.;\n  return loc.x + gone + g; /* end */ }\nvoid broken() { fun(g, + ; vec3 nor = \n}";
    let m = Marked::code(code);
    let analysis = m.analysis();
    let classes = analysis.classes(CODE);
    let class = |what: &str| {
        let at = m.code.rfind(what).unwrap_or_else(|| panic!("{what}"));
        classes.iter().find(|c| c.range.contains(&at)).map(|c| c.class)
    };
    for (what, expected) in [
        ("#define", Some(C::Preprocessor)),
        ("PI 3.", Some(C::Macro)),
        ("3.\n#if", Some(C::Number)),
        ("old", Some(C::Inactive)),
        ("/* x", Some(C::Inactive)),
        ("#else", Some(C::Preprocessor)),
        ("struct", Some(C::Keyword)),
        ("S { float", Some(C::Type)),
        ("a; };", Some(C::Field)),
        ("g = PI", Some(C::Global)),
        ("PI;", Some(C::Macro)),
        ("float fun", Some(C::Type)),
        ("fun(float", Some(C::Function)),
        ("par, S", Some(C::Parameter)),
        ("S s) {", Some(C::Type)),
        ("// note", Some(C::Comment)),
        ("loc =", Some(C::Local)),
        ("sin(", Some(C::Builtin)),
        ("par) +", Some(C::Parameter)),
        ("a + iTime", Some(C::Field)),
        ("iTime", Some(C::Uniform)),
        ("return", Some(C::Keyword)),
        ("x + gone", Some(C::Field)),
        ("gone", Some(C::Unknown)),
        ("g; /*", Some(C::Global)),
        ("/* end */", Some(C::Comment)),
        ("fun(g", Some(C::Function)),
        ("g, +", Some(C::Global)),
        ("+ ; vec3", None),
    ] {
        assert_eq!(class(what), expected, "{what}");
    }
    for pair in classes.windows(2) {
        assert!(pair[0].range.end <= pair[1].range.start, "{pair:?}");
    }
}

#[test]
fn custom_uniform_is_resolved_in_all_texts() {
    let common = "float twice() { return 2.0 * speed; }\n#define HALF (0.5 * speed)\n#define NEVER 1\n";
    let code = "float f(float speed) { return speed; }\nfloat g() { return HALF + speed + nothing(speed);";
    let custom_uniforms = [CustomUniform::new("speed", CustomUniformKind::Float, 0)];
    let analysis = Analysis::new(&PassSource {
        common: Some(Text { id: COMMON, text: common }),
        custom_uniforms: &custom_uniforms,
        ..PassSource::new(PassKind::Image, Text { id: CODE, text: code })
    });
    let places = |source: SourceId, text: &str| -> Vec<usize> {
        let all = analysis.uses_of_custom_uniform("speed").into_iter().filter(|span| span.source == source);
        all.inspect(|span| assert_eq!(&text[span.range()], "speed")).map(|span| span.start as usize).collect()
    };
    let of = |text: &str| -> Vec<usize> { text.match_indices("speed").map(|(at, _)| at).collect() };
    assert_eq!(places(COMMON, common), of(common));
    // The parameter of the same name is a different item.
    assert_eq!(places(CODE, code), of(code)[2..]);
    let named = |at: usize| analysis.custom_uniform_at(CODE, at);
    assert_eq!((named(of(code)[0]), named(of(code)[1])), (None, None));
    assert_eq!((named(of(code)[2]), named(of(code)[3])), (Some("speed"), Some("speed")));
    assert_eq!(analysis.uses_of_custom_uniform("pace"), []);
    for (name, is_declared) in [("f", true), ("g", true), ("NEVER", true), ("speed", false), ("other", false)] {
        assert_eq!(analysis.declares(name), is_declared, "{name}");
    }
}
