//! Completion: which items, and in which order.

use super::Marked;
use crate::{
    Include, PassKind, PassSource, Text,
    services::{Analysis, CompletionKind, Completions},
};
use eddy_diag::{SourceId, Span};

fn at(m: &Marked) -> (Completions, String) {
    let found = m.analysis().completions(m.at.0, m.at.1);
    let text = if m.at.0 == super::COMMON { &m.common } else { &m.code };
    let typed = text[found.replace.clone()].to_owned();
    (found, typed)
}

/// Returns the labels that match what is typed, best first.
fn labels(common: &str, code: &str) -> Vec<String> {
    let (found, typed) = at(&Marked::new(common, code));
    found.matching(&typed).into_iter().map(|i| found.items[i].label.clone()).collect()
}

#[test]
fn wanted_name_ranks_near_the_top() {
    for (code, wanted) in [
        ("void f() { vec3 c = nor@", "normalize"),
        ("void f() { vec3 c = nor@\n float y = 1.; }", "normalize"),
        ("void f() { vec3 c = smooths@(1.); }", "smoothstep"),
        ("void f() { float speed = 1.; float y = sp@; }", "speed"),
        ("void f(vec2 position) { float y = length(pos@ }", "position"),
        ("float shade(vec3 p) { return 1.; }\nvoid f() { sha@", "shade"),
        ("#define TAU 6.28\nfloat x = TA@;", "TAU"),
        ("const int COUNT = 3;\nvoid f() { for (int i = 0; i < COU@; i++) {} }", "COUNT"),
        ("struct Ray { vec3 o; };\nvoid f() { Ra@ }", "Ray"),
        ("void f() { vec2 uv = p / iRes@", "iResolution"),
        ("void f() { texture(iCh@", "iChannel0"),
        ("void f() { vec4 t = texelF@", "texelFetch"),
        ("void f() { retu@", "return"),
        ("void f() { for (int step = 0; step < 3; step++) { ste@ } }", "step"),
        ("#def@", "define"),
        ("#define WIDE 1\n#ifdef WI@", "WIDE"),
        ("#define WIDE 1\n#if def@", "defined"),
        ("void mainI@", ""),
        ("voi@", "void"),
        ("mainI@", "mainImage"),
        ("void f() { float other; { float inner; } oth@", "other"),
        ("void f() { gl_Fra@", "gl_FragCoord"),
        ("void f() { normalze@", "normalize"),
        ("#define F(x) (x + iTi@)", "iTime"),
    ] {
        let found = labels("", code);
        assert_eq!(found.first().map_or("", |s| s.as_str()), wanted, "{code}: {:?}", &found[..found.len().min(5)]);
    }
    assert_eq!(labels("float noise3(vec3 p) { return 1.; }", "void f() { noi@")[0], "noise3");
    assert_eq!(labels("const float DEPTH = 2.;\nfloat g() { return DE@; }", "")[0], "DEPTH");
}

#[test]
fn members_follow_from_the_type_before_the_point() {
    for (code, wanted) in [
        ("void f(vec2 p) { p.@ }", "x y xy"),
        ("void f(vec2 p) { float y = p.@\n}", "x y xy"),
        ("struct R { vec3 o; float t; };\nvoid f(R r) { r.@; }", "o t"),
        ("struct R { vec3 o; float t; };\nvoid f(R r) { r.o.@; }", "x y z"),
        ("struct R { vec3 o; float t; };\nR make() { R r; return r; }\nvoid f() { make().@ }", "o t"),
        ("struct R { vec2 o; };\nvoid f() { R all[3]; all[1].o.@ }", "x y xy"),
        ("struct R { vec2 o; };\nvoid f() { R all[3]; all.@ }", "length()"),
        ("void f(vec3 a, mat3 m) { (m * a).@ }", "x y z"),
        ("void f(vec3 a) { (2. * a.xy + 1.).@ }", "x y xy"),
        ("void f(vec3 a) { normalize(a).@ }", "x y z"),
        ("void f(vec2 a) { foo(1., abs(a).@ }", "x y xy"),
        ("void f() { texture(iChannel0, vec2(1)).@ }", "x y z w"),
        ("void f() { mat2(1.)[0].@ }", "x y xy"),
        ("#define R iResolution.xy\nvoid f() { R.@ }", "x y xy"),
        ("#define rot(a) mat2(cos(a), sin(a), -sin(a), cos(a))\nvoid f(vec2 p) { (rot(1.) * p).@ }", "x y xy"),
        ("void f() { iCh0.@ }", "sampler size time loaded"),
        ("void f() { iCh0.size.@ }", "x y z"),
        ("void f() { iChannelResolution[0].@ }", "x y z"),
        ("void f() { iMouse.@ }", "x y z w"),
        ("void f(float x) { (x > 1. ? vec2(1) : vec2(2)).@ }", "x y xy"),
        ("void f(float x) { x.@ }", ""),
        ("void f() { nobody.@ }", ""),
        ("void f() { 1.@ }", ""),
    ] {
        let (found, typed) = at(&Marked::code(code));
        assert_eq!(typed, "");
        let all: Vec<&str> = found.items.iter().map(|i| i.label.as_str()).collect();
        let wanted: Vec<&str> = wanted.split_whitespace().collect();
        assert_eq!(all.get(..wanted.len()), Some(&wanted[..]), "{code}: {all:?}");
        assert!(!wanted.is_empty() || all.is_empty(), "{code}: {all:?}");
    }
}

#[test]
fn no_completions_where_no_name_is_valid() {
    for code in [
        "// nor@",
        "/* nor@ */",
        "#if 0\nnor@\n#endif",
        "float x = 1.5@;",
        "void f() { float nor@ }",
        "struct R { float a; };\nvoid f() { R nor@ }",
        "#define nor@",
        "#version 3@",
        "float nor@(",
    ] {
        let (found, typed) = at(&Marked::code(code));
        assert_eq!(found.matching(&typed), Vec::<usize>::new(), "{code}");
    }
}

#[test]
fn completions_respect_scopes() {
    let has = |code: &str, name: &str| labels("", code).iter().any(|l| l == name);
    assert!(!has("void f() { { float inner; } inn@", "inner"));
    assert!(!has("void f() { for (int idx = 0; idx < 3; idx++) { } id@", "idx"));
    assert!(has("void f() { for (int idx = 0; id@ < 3; idx++) { } ", "idx"));
    assert!(!has("void g(float only) { }\nvoid f() { onl@", "only"));
    assert!(!has("void f() { onl@ }\nfloat only;", "only"));
    assert!(!has("void f() { float self = sel@; }", "self"));
    assert!(has("void f(float arg) { if (arg > 1.) { ar@", "arg"));
    // An open brace above hides nothing.
    assert!(has("void g() { if (true) {\n}\nvoid f(float arg) { ar@ }", "arg"));
    // One name, one item: the innermost.
    let (found, _) = at(&Marked::code("float v;\nvoid f(vec2 v) { { vec3 v; v@ } }"));
    let all: Vec<_> = found.items.iter().filter(|i| i.label == "v").collect();
    assert_eq!((all.len(), all[0].detail.as_str()), (1, "vec3 v"));
}

#[test]
fn completions_have_kind_and_detail() {
    let code =
        "// Length of it.\nfloat len(vec2 p) { return 1.; }\nfloat len(vec3 p) { return 1.; }\nvoid f(vec2 q) { @ }";
    let (found, _) = at(&Marked::code(code));
    let item = |label: &str| found.items.iter().find(|i| i.label == label).unwrap();
    assert_eq!(item("len").detail, "float len(vec2 p)  (+1)");
    assert_eq!(item("len").doc, "Length of it.");
    assert_eq!(item("len").kind, CompletionKind::Function);
    assert_eq!((item("q").kind, item("q").detail.as_str()), (CompletionKind::Parameter, "vec2 q"));
    assert_eq!(item("clamp").detail, "genType clamp(genType x, genType minVal, genType maxVal)  (+5)");
    assert!(item("iMouse").doc.contains("z > 0 while it is held"));
    assert_eq!(item("vec3").kind, CompletionKind::Type);
    assert!(found.items.iter().all(|i| i.label != "iTimeOffset"), "Image has no such uniform");
}

#[test]
fn plain_shaders_have_no_shadertoy_names() {
    let text = "#version 300 es\nprecision highp float;\nout vec4 color;\nvoid main() { color = vec4(i";
    let analysis = Analysis::new(&PassSource::fragment(text));
    let labels: Vec<String> =
        analysis.completions(SourceId(0), text.len()).items.into_iter().map(|item| item.label).collect();
    let of_site =
        |label: &&String| ["iTime", "iResolution", "iChannel", "iCh0"].iter().any(|name| label.starts_with(name));
    assert_eq!(labels.iter().find(of_site), None);
    assert!(labels.iter().any(|label| label == "gl_FragCoord") && labels.iter().any(|label| label == "inversesqrt"));
}

#[test]
fn included_file_sees_earlier_declarations() {
    let code = "#define SCALE 2.0\nconst int PASS = 1;\n\n#include \"a.glsl\"\n\nconst int LATER = 2;\n";
    let included = "float f() { return 1.0; }\n";
    let text = |id, text| Text { id: SourceId(id), text };
    let at = code.find("#include").unwrap();
    let line = Span::new(SourceId(1), at..at + "#include \"a.glsl\"".len());
    let includes = [Include { line, text: Ok(text(7, included)) }];
    let pass = PassSource { includes: &includes, ..PassSource::new(PassKind::Image, text(1, code)) };
    let found = Analysis::new(&pass).completions(SourceId(7), included.find("1.0").unwrap());
    let has = |name: &str| found.items.iter().any(|item| item.label == name);
    assert_eq!(["SCALE", "PASS", "LATER"].map(has), [true, true, false]);
}
