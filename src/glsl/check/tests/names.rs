//! Tests the side table for editors: every use of a name and its target.

use super::checked;
use crate::{
    ChannelKind,
    hir::{BuiltinVar, DeclRef, Uniform},
};

const CODE: &str = "struct S { float a; vec2 b; };
const float K = 2.0;
float g(S s) { return s.b.x * K; }
float h;
void mainImage(out vec4 c, in vec2 f) {
    S s = S(1.0, f);
    float K = g(s) + unknown;
    { float h = K; c = sin(vec4(h)) + iTime * texture(iChannel2, gl_FragCoord.xy); }
    h = float(gl_MaxDrawBuffers);
}";

#[test]
fn uses_refer_to_their_declarations() {
    let source = crate::PassSource::image(CODE);
    let parsed = crate::parse::parse(&source, None);
    let (checked, failed, _) = checked(source.kind, [ChannelKind::Sampler2D; 4], None, CODE);
    assert!(failed, "`unknown` is not declared; the rest must be known all the same");
    let module = &checked.module;
    let mut found: Vec<(usize, &str, String)> = module
        .uses
        .iter()
        .map(|used| {
            let span = parsed.origins.token_span(used.token);
            let name = |ident: crate::ast::Ident| parsed.origins.token_span(ident.token).start.to_string();
            let target = match used.target {
                DeclRef::Local(id) => format!("local at {}", name(module[id].name.unwrap())),
                DeclRef::Global(id) => format!("global at {}", name(module[id].name)),
                DeclRef::Func(id) => format!("function at {}", name(module[id].name)),
                DeclRef::Struct(id) => format!("struct at {}", name(module[id].name.unwrap())),
                DeclRef::Member(id, i) => format!("member at {}", name(module[module[id].members][i as usize].name)),
                other => format!("{other:?}"),
            };
            (span.start as usize, &CODE[span.range()], target)
        })
        .collect();
    found.sort();
    let at = |text: &str, nth: usize| CODE.match_indices(text).nth(nth).unwrap().0;
    let (k, big_h) = (at("K = 2", 0), at("h;", 0));
    let member_b = at("b; }", 0);
    let (param_s, local_s) = (at("s) {", 0), at("s = S(", 0));
    let (local_k, inner_h) = (at("K = g", 0), at("h = K", 0));
    let (c, f) = (at("c, in", 0), at("f) {", 0));
    let expected = [
        ("S", format!("struct at {}", at("S {", 0))),
        ("s", format!("local at {param_s}")),
        ("b", format!("member at {member_b}")),
        ("K", format!("global at {k}")),
        ("S", format!("struct at {}", at("S {", 0))),
        ("S", format!("struct at {}", at("S {", 0))),
        ("f", format!("local at {f}")),
        ("g", format!("function at {}", at("g(S", 0))),
        ("s", format!("local at {local_s}")),
        ("K", format!("local at {local_k}")),
        ("c", format!("local at {c}")),
        ("sin", "Builtin(sin)".into()),
        ("h", format!("local at {inner_h}")),
        ("iTime", format!("{:?}", DeclRef::Uniform(Uniform::Time))),
        ("texture", "Builtin(texture)".into()),
        ("iChannel2", format!("{:?}", DeclRef::Channel(2))),
        ("gl_FragCoord", format!("{:?}", DeclRef::BuiltinVar(BuiltinVar::FragCoord))),
        ("h", format!("global at {big_h}")),
    ];
    let names: Vec<(&str, String)> = found.into_iter().map(|(_, name, target)| (name, target)).collect();
    let (last, rest) = names.split_last().unwrap();
    assert_eq!(rest, expected);
    assert!(last.0 == "gl_MaxDrawBuffers" && last.1.starts_with("BuiltinConst"));
}

#[test]
fn common_alone_has_two_uniforms() {
    let common = "#define NOW iTime\nfloat f() { return iDate.w + iSampleRate; }\nfloat g() { return iTime; }\n\
                  vec4 h(vec2 p) { return texture(iChannel0, p) + iResolution.x + iTime; }\n\
                  void i(out vec4 c) { mainImage(c, vec2(0)); }\n";
    let warnings = crate::check_common(crate::Text { id: eddy_diag::SourceId(0), text: common }, &[], &[]);
    let named: Vec<&str> = warnings.iter().map(|d| &common[d.span.unwrap().range()]).collect();
    assert_eq!(named, ["iTime", "iChannel0", "iResolution", "mainImage(c, vec2(0))"]);
    assert!(warnings.iter().all(|d| !d.is_error()));
    assert!(
        crate::check_common(crate::Text { id: eddy_diag::SourceId(0), text: "int f() { return x }" }, &[], &[])
            .is_empty()
    );
}
