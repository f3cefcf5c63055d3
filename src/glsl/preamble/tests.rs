//! Passes with a precompiled Common, compared with the same passes that parse it themselves.

use super::*;
use crate::{
    ChannelKind, Compiled, CustomUniformKind, Link, PassKind, UntypedValue, compile_linked, diagnose, dump_ir,
    services::Analysis,
};
use eddy_diag::{SourceId, Span};

const COMMON: SourceId = SourceId(0);
const CODE: SourceId = SourceId(1);
const INCLUDED: SourceId = SourceId(2);
const IMAGE: &str = "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x), p, 1.0); }";

/// The part of Common that is precompiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    Nothing,
    Tree,
    Checked,
}

/// A Common and a pass that follows it.
struct Case<'a> {
    kind: PassKind,
    common: &'a str,
    code: &'a str,
    includes: &'a [Include<'a>],
    custom_uniforms: &'a [CustomUniform<'a>],
    values: &'a [UniformValue],
    channels: [ChannelKind; 4],
}

impl<'a> Case<'a> {
    fn new(common: &'a str, code: &'a str) -> Self {
        let channels = [ChannelKind::Sampler2D; 4];
        Self { kind: PassKind::Image, common, code, includes: &[], custom_uniforms: &[], values: &[], channels }
    }

    fn source(&self) -> PassSource<'a> {
        PassSource {
            common: Some(Text { id: COMMON, text: self.common }),
            includes: self.includes,
            custom_uniforms: self.custom_uniforms,
            values: self.values,
            channels: PassSource::channel_kinds(self.channels),
            ..PassSource::new(self.kind, Text { id: CODE, text: self.code })
        }
    }

    /// Compiles both ways, compares all results, and returns what was kept and the messages.
    #[track_caller]
    fn run(&self) -> (Kept, Vec<String>) {
        let source = self.source();
        let common = source.common.expect("one was given");
        let preamble = Preamble::new(common, self.includes, self.values);
        let compile = |preamble| compile_linked(&source, &Link::default(), preamble);
        let dump = |preamble| dump_ir(&source, &Link::default(), preamble, None);
        let said = |outcome: Result<Compiled, Vec<Diagnostic>>| match outcome {
            Ok(compiled) => (format!("{:?}", compiled.module), compiled.diagnostics),
            Err(errors) => (String::new(), errors),
        };
        let (module, diagnostics) = said(compile(None).map_err(Vec::from));
        let (module_behind, diagnostics_behind) = said(compile(preamble.as_ref()).map_err(Vec::from));
        assert_eq!(diagnostics, diagnostics_behind);
        assert_eq!(dump(None), dump(preamble.as_ref()));
        assert_eq!(module, module_behind);
        assert_eq!(diagnose(&source), diagnostics);
        self.compare_analyses(preamble.as_ref());
        let kept = match &preamble {
            None => Kept::Nothing,
            Some(preamble) if preamble.checked(&source).is_some() => Kept::Checked,
            Some(_) => Kept::Tree,
        };
        (kept, diagnostics.into_iter().map(|d| d.message).collect())
    }

    /// Compares the editor's answers for each position.
    #[track_caller]
    fn compare_analyses(&self, preamble: Option<&Preamble>) {
        let (own, reused) = (Analysis::new(&self.source()), Analysis::with_preamble(&self.source(), preamble));
        for (id, text) in [(COMMON, self.common), (CODE, self.code)] {
            assert_eq!(own.classes(id), reused.classes(id));
            for offset in 0..text.len() {
                assert_eq!(own.uses(id, offset), reused.uses(id, offset), "at {offset}");
                assert_eq!(own.definition(id, offset), reused.definition(id, offset), "at {offset}");
            }
        }
    }

    #[track_caller]
    fn assert_kept(&self, kept: Kept, messages: &[&str]) {
        let (was_kept, said) = self.run();
        assert_eq!((was_kept, said.iter().map(String::as_str).collect::<Vec<_>>()), (kept, messages.to_vec()));
    }
}

#[track_caller]
fn assert_kept(common: &str, code: &str, kept: Kept, messages: &[&str]) {
    Case::new(common, code).assert_kept(kept, messages);
}

#[test]
fn declarations_are_parsed_once() {
    let common = "
#define PI 3.14
struct Ray { vec3 at; float t[2]; };
const float K[2] = float[2](PI, 2.0);
float global = 1.0;
float g(Ray r);
float f(float x) { global += x; return K[int(x)] * global; }
float f(vec2 x) { return f(x.x) + f(x.y); }
float g(Ray r) { return r.t[0] + iDate.x; }
";
    let code = "float h(Ray r) { return g(r) * PI; }
void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p), h(Ray(vec3(0), float[2](p.x, p.y))), iTime, global); }";
    assert_kept(common, code, Kept::Checked, &[]);
    assert_kept(
        "",
        "float f(float x) { return x; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }",
        Kept::Checked,
        &[],
    );
}

#[test]
fn macros_of_common_apply_in_the_pass() {
    let common = "#define A(x) ((x) + B)\n#define B 2.0\nfloat f(float x) { return A(x); }";
    assert_kept(common, IMAGE, Kept::Checked, &[]);
    assert_kept(
        common,
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(A(p.x), B, f(A(B)), 1.0); }",
        Kept::Checked,
        &[],
    );
    // A macro that names something of the pass does so only where it is used.
    let common = "#define T iTime\n#define READ(p) texture(iChannel0, p)\nfloat f(float x) { return x; }";
    assert_kept(common, "void mainImage(out vec4 c, in vec2 p) { c = READ(p) * T; }", Kept::Checked, &[]);
}

#[test]
fn pass_may_redefine_a_macro_of_common() {
    let common = "#define A 1.0\nfloat f(float x) { return x + A; }";
    let twice = format!("#define A 2.0\n{IMAGE}");
    assert_kept(common, &twice, Kept::Checked, &["the macro `A` is already defined differently"]);
    let again = format!("#undef A\n#define A 2.0\nfloat g() {{ return A; }}\n{IMAGE}");
    assert_kept(common, &again, Kept::Checked, &[]);
    let same = format!("#define A 1.0\n{IMAGE}");
    assert_kept(common, &same, Kept::Checked, &[]);
}

#[test]
fn an_entry_point_may_be_a_macro_of_common() {
    let common = "#define mainImage(c, p) c = vec4(f(p.x))\nfloat f(float x) { return x; }";
    assert_kept(common, "// Nothing else.", Kept::Checked, &[]);
}

#[test]
fn text_that_spans_the_border_is_parsed_with_each_pass() {
    assert_kept(
        "float f(float x) ",
        "{ return x; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }",
        Kept::Nothing,
        &[],
    );
    assert_kept("float f(float x) { return x; }\nfloat a = 1.0", &format!("; {IMAGE}"), Kept::Nothing, &[]);
    assert_kept(
        "float f(float x) { return x; }\n#if 1\nfloat a;",
        &format!("#else\nfloat b;\n#endif\n{IMAGE}"),
        Kept::Nothing,
        &[],
    );
    assert_kept(
        "float f(float x) { return x; }\n#if 0\nfloat a;",
        &format!("#else\nfloat b;\n#endif\n{IMAGE}"),
        Kept::Nothing,
        &[],
    );
    assert_kept("#define F(x) float f(float x) { return x; }\nF", &format!("(x)\n{IMAGE}"), Kept::Nothing, &[]);
    let (kept, said) = Case::new("float f(float x) { return x; }\n/* here", &format!("and here */\n{IMAGE}")).run();
    assert_eq!(kept, Kept::Nothing);
    assert!(said.iter().any(|m| m.contains("this comment is not closed")), "{said:?}");
}

#[test]
fn error_in_common_is_reported_with_each_pass() {
    let (kept, said) = Case::new("float f(float x) { return x }", IMAGE).run();
    assert_eq!(kept, Kept::Nothing);
    assert_eq!(said.len(), 1, "{said:?}");
    let (kept, said) = Case::new("float f(float x) { return y; }", IMAGE).run();
    assert_eq!(kept, Kept::Tree, "what does not fit is for each pass to say");
    assert_eq!(said.len(), 1, "{said:?}");
}

#[test]
fn warning_in_common_is_reported_with_each_pass() {
    let common = "#define a__b 1.0\nfloat f(float x) { return x * a__b; }";
    assert_kept(common, IMAGE, Kept::Checked, &["`a__b`: names with two underscores in a row are reserved"]);
}

#[test]
fn line_numbers_depend_on_the_pass() {
    assert_kept("float f(float x) { return x + float(__LINE__); }", IMAGE, Kept::Nothing, &[]);
    assert_kept("#if __LINE__ < 17\nfloat iTime;\n#endif\nfloat f(float x) { return x; }", IMAGE, Kept::Nothing, &[]);
    assert_kept("#line 10\nfloat f(float x) { return x; }", IMAGE, Kept::Nothing, &[]);
    let code = "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x), __LINE__, __FILE__, 1); }";
    assert_kept("float f(float x) { return x; }\n\n\n", code, Kept::Checked, &[]);
}

#[test]
fn names_that_differ_between_passes_are_checked_with_each() {
    for common in [
        "float f(float x) { return x * iTime; }",
        "float f(float x) { return texture(iChannel0, vec2(x)).x; }",
        "float f(float x) { st_assert(x > 0.0, 1); return x; }",
    ] {
        assert_kept(common, IMAGE, Kept::Tree, &[]);
    }
    assert_kept(
        "float iCh0 = 1.0;\nfloat f(float x) { return x * iCh0; }",
        IMAGE,
        Kept::Tree,
        &["`iCh0` is already declared by Shadertoy's header", "`iCh0` is a struct and cannot be used as a value"],
    );
    let cube = "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }";
    let mut case = Case::new("float f(float x) { return texture(iChannel0, vec3(x)).x; }", cube);
    case.channels[0] = ChannelKind::SamplerCube;
    case.assert_kept(Kept::Tree, &[]);
    let mut case = Case::new(
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }",
        "vec2 mainSound(int s, float t) { return vec2(t); }",
    );
    case.kind = PassKind::Sound;
    case.assert_kept(Kept::Tree, &[]);
    case.kind = PassKind::Buffer;
    case.assert_kept(Kept::Tree, &[]);
}

#[test]
fn pass_may_use_built_in_names_that_common_does_not() {
    let code = "float mix;
void mainImage(out vec4 c, in vec2 p) { c = gl_FragCoord * f(p.x) + float(gl_MaxDrawBuffers) + gl_DepthRange.near; }";
    assert_kept("float f(float x) { return x; }", code, Kept::Checked, &[]);
    let code = "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x) + sin.x); }";
    assert_kept("struct S { float x; };\nS sin;\nfloat f(float x) { return x; }", code, Kept::Checked, &[]);
}

#[test]
fn every_kind_of_pass_continues_from_the_same_preamble() {
    let common = "float f(float x) { return x * 2.0 + gl_FragCoord.x; }";
    for (kind, code) in [
        (
            PassKind::Image,
            "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)) + iCh0.time; st_assert(true, 1); }",
        ),
        (PassKind::Buffer, "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }"),
        (PassKind::Cubemap, "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(f(p.x), d); }"),
        (PassKind::Sound, "vec2 mainSound(int s, float t) { return vec2(f(t), iSampleRate); }"),
    ] {
        let mut case = Case::new(common, code);
        case.kind = kind;
        case.assert_kept(Kept::Checked, &[]);
    }
    // The stages of a mesh have other variables, and check Common themselves.
    let mut case = Case::new(common, "out vec4 colour;\nvoid main() { colour = vec4(f(1.0)); }");
    case.kind = PassKind::Fragment;
    case.assert_kept(Kept::Tree, &[]);
}

#[test]
fn custom_uniforms_are_checked_with_each_pass_that_has_them() {
    let custom_uniforms = [CustomUniform::new("speed", CustomUniformKind::Float, 0)];
    let mut case = Case::new("float f(float x) { return x * speed; }", IMAGE);
    case.custom_uniforms = &custom_uniforms;
    case.assert_kept(Kept::Tree, &[]);
    let code = "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x) * speed); }";
    let mut case = Case::new("float f(float x) { return x; }", code);
    case.custom_uniforms = &custom_uniforms;
    case.assert_kept(Kept::Checked, &[]);
    let values = [UniformValue { name: "gain".into(), value: UntypedValue::Number(3.0) }];
    let mut case = Case::new("uniform float gain;\nfloat f(float x) { return x * gain; }", IMAGE);
    case.values = &values;
    case.assert_kept(Kept::Checked, &[]);
    let other = [UniformValue { name: "gain".into(), value: UntypedValue::Number(4.0) }];
    let preamble = Preamble::new(case.source().common.unwrap(), &[], &other).expect("it is self-contained");
    assert!(preamble.checked(&case.source()).is_none(), "it was read for another value");
}

#[test]
fn common_includes_a_text() {
    let common = "#include \"noise.glsl\"\nfloat f(float x) { return noise(x) * N; }";
    let line = Span::new(COMMON, 0..common.find('\n').unwrap());
    let text = |text| [Include { line, text: Ok(Text { id: INCLUDED, text }) }];
    let whole = text("#define N 2.0\nfloat noise(float x) { return fract(x * N); }");
    let mut case = Case::new(common, IMAGE);
    case.includes = &whole;
    case.assert_kept(Kept::Checked, &[]);
    let broken = text("#define N 2.0\nfloat noise(float x) { return fract(x * N);");
    case.includes = &broken;
    let (kept, said) = case.run();
    assert_eq!((kept, said.is_empty()), (Kept::Nothing, false));
    // A missing file is an error only where its line is compiled.
    let said = Diagnostic::error(line, "there is no file noise.glsl");
    let missing = [Include { line, text: Err(&said) }];
    let mut case = Case::new(common, IMAGE);
    case.includes = &missing;
    let (kept, messages) = case.run();
    assert!(kept == Kept::Nothing && messages[0] == said.message, "{messages:?}");
    let guarded = "#if 0\n#include \"noise.glsl\"\n#endif\nfloat f(float x) { return x; }";
    let at = Span::new(COMMON, 6..guarded.find("\n#endif").unwrap());
    let missing = [Include { line: at, text: Err(&said) }];
    let mut case = Case::new(guarded, IMAGE);
    case.includes = &missing;
    case.assert_kept(Kept::Checked, &[]);
    let code = format!("#include \"noise.glsl\"\n{IMAGE}");
    let line = Span::new(CODE, 0..code.find('\n').unwrap());
    let in_pass = [Include { line, text: Ok(Text { id: INCLUDED, text: "float g() { return 1.0; }" }) }];
    let mut case = Case::new("float f(float x) { return x; }", &code);
    case.includes = &in_pass;
    case.assert_kept(Kept::Checked, &[]);
}

#[test]
fn errors_across_the_border_are_unchanged() {
    let common = "float f(float x) { return x; }\nfloat twice;";
    for code in [
        "float f(float x) { return 2.0 * x; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }",
        "float twice;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }",
        "float g() { return f(vec2(1.0)); }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }",
        "}\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(ff(p.x)); }",
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x);",
        "",
    ] {
        let (kept, said) = Case::new(common, code).run();
        assert_eq!((kept, said.is_empty()), (Kept::Checked, false), "{code}");
    }
}
