//! Planted faults, and code without faults.

use super::*;
use crate::trace::STEPS;
use bytemuck::Zeroable;
use eddy_engine::{Level as TextureLevel, PassInputs, Sources, TextureCopy};
use eddy_glsl::interface::UniformBlock;
use eddy_project::{Filter, Project};

fn inputs() -> PassInputs {
    let uniforms = UniformBlock { resolution: [8.0, 4.0, 1.0], time: 0.5, ..UniformBlock::zeroed() };
    let channels = std::array::from_fn(|_| TextureCopy::black());
    PassInputs { uniforms, custom_uniforms: Vec::new(), channels, size: (8, 4), face: 0, meshes: Vec::new() }
}

pub(super) fn audited(code: &str) -> Audit {
    let project = Project::of_image("Untitled".into(), code.into());
    let pixels: Vec<(u32, u32)> = (0..4).flat_map(|y| (0..8).map(move |x| (x, y))).collect();
    audit(&Sources::new(&project), 0, &inputs(), &pixels, STEPS).unwrap()
}

fn image(body: &str) -> String {
    format!("void mainImage(out vec4 o, in vec2 p) {{\n{body}\n}}\n")
}

fn named<'a>(code: &'a str, audit: &'a Audit) -> Vec<(&'static str, &'a str)> {
    let text = |finding: &Finding| finding.span.map_or("", |span| &code[span.range()]);
    audit.findings.iter().map(|finding| (finding.kind.name(), text(finding))).collect()
}

#[test]
fn correct_code_has_no_findings() {
    let code = image(
        "vec3 n = normalize(vec3(p, 1.));\nfloat d = 0.;\nfor (int i = 0; i < 9; i++) d += sqrt(float(i)) * n.x;\n\
         o = vec4(n * smoothstep(0., 1., d), pow(abs(n.y), 2.));",
    );
    let audit = audited(&code);
    assert_eq!(named(&code, &audit), []);
    assert_eq!(audit.pixels.len(), 32);
    assert!(audit.pixels.iter().all(|p| p.error < 1e-5), "{:?}", audit.pixels[0]);
    assert!(audit.pixels.iter().any(|p| p.error > 0.0), "two precisions round differently");
}

#[test]
fn cancellation_is_the_cause_of_the_error() {
    let code = image("float a = 1000. + p.x * 1e-3;\nfloat b = a * a - 1e6;\no = vec4(b * 0.5, 0., 0., 1.);");
    let audit = audited(&code);
    let rounding: Vec<_> = audit.findings.iter().filter(|f| f.kind.class() == Class::Rounding).collect();
    assert_eq!(rounding.len(), 1, "{:?}", named(&code, &audit));
    let finding = rounding[0];
    assert_eq!(&code[finding.span.unwrap().range()], "a * a - 1e6");
    assert!(finding.kind.message().starts_with("cancellation"), "{}", finding.kind.message());
    let (error, left) = finding.error.unwrap();
    assert!(error > 1e-3 && left < error / 100.0, "{error} {left}");
}

#[test]
fn jitter_moves_only_inexact_results() {
    let moved = |body: &str| {
        let project = Project::of_image("Untitled".into(), image(body));
        let (sources, inputs) = (Sources::new(&project), inputs());
        let values: Vec<[f32; 4]> =
            (0..8).map(|seed| add_jitter(&sources, 0, &inputs, (5, 2), (STEPS, seed)).unwrap()).collect();
        values.iter().map(|value| (value[0] - values[0][0]).abs()).fold(0.0, f32::max)
    };
    assert_eq!(moved("float s = 0.; for (int i = 0; i < 9; i++) s += p.x * float(i); o = vec4(s);"), 0.0);
    let last_bits = moved("o = vec4(p.x / 3.);");
    assert!(last_bits > 0.0 && last_bits < 4e-6, "{last_bits}");
    let hash = moved("float a = fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); o = vec4(a);");
    assert!(hash > 1e-3, "{hash}");
}

#[test]
fn large_angle_is_reported() {
    let code = image("o = vec4(sin(p.x * 7e4 / 3.), 0., 0., 1.);");
    let audit = audited(&code);
    assert!(audit.findings.iter().any(|f| f.kind.message().starts_with("a trigonometric function of a large number")));
    // The common hash by fract of a large sine.
    let code = image("o = vec4(fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453), 0., 0., 1.);");
    let audit = audited(&code);
    assert!(audit.pixels.iter().any(|p| p.error > 1e-4));
    assert!(named(&code, &audit).iter().any(|(kind, text)| *kind == "rounding" && text.starts_with("fract")));
}

#[test]
fn reads_before_writes_are_found() {
    for (body, name) in [
        ("float a;\nif (p.x > 4.) a = 1.;\no = vec4(a * 2.);", "a"),
        ("float a;\no = vec4(a + 1.);", "a"),
        ("vec2 v;\nv.x = 1.;\no = vec4(v.y - 1.);", "v"),
        ("bool b;\no = vec4(1.);\nif (b) o = vec4(p, 0., 1.);", "b"),
        ("bool b;\nif (p.x > 4.) b = true;\no = b ? vec4(p, 0., 1.) : vec4(1.);", "b"),
        ("bool b;\no = vec4(p.x > 9. || b);", "b"),
        ("int k;\no = vec4(1.);\nswitch (k) { case 1: o = vec4(p, 0., 1.); }", "k"),
        ("bool b;\no = vec4(1.);\nwhile (b) { o += 1.; b = false; }", "b"),
        ("if (p.x > 4.) o = vec4(1.);", "o"),
    ] {
        let code = image(body);
        assert_eq!(named(&code, &audited(&code)), [("undefined", name)], "{body}");
    }
    for body in [
        // The fourth component is computed and discarded.
        "vec4 v;\nv.xyz = vec3(p, 1.);\nv *= 2.;\no = vec4(v.xyz, 1.);",
        // The picture has no alpha.
        "o.xyz = vec3(p, 1.);",
        "float s = 0.;\nfor (int i = 0; i < 3; i++) { float t; t = float(i); s += t; }\no = vec4(s);",
    ] {
        let code = image(body);
        assert_eq!(named(&code, &audited(&code)), [], "{body}");
    }
    let global =
        "float g;\nfloat set;\nvoid f() { set = 1.; }\nvoid mainImage(out vec4 o, vec2 p) { f(); o = vec4(g + set); }";
    assert_eq!(named(global, &audited(global)), [("undefined", "g")]);
}

#[test]
fn consequences_of_undefined_values_are_reported_at_the_source() {
    let code = image("vec3 n;\nfloat r;\no = vec4(normalize(n), 1. / r);");
    let audit = audited(&code);
    assert_eq!(named(&code, &audit), [("undefined", "n")]);
    assert_eq!((&*audit.findings[0].numbers, audit.findings[0].pixels), ("n", 32));
}

#[test]
fn a_buffer_shows_every_component_that_it_stores() {
    let mut project = Project::of_image("Untitled".into(), image("o.xyz = vec3(p, 1.);"));
    project.passes[0].id = eddy_project::PassName::buffer("A");
    let audit = audit(&Sources::new(&project), 0, &inputs(), &[(1, 1)], STEPS).unwrap();
    assert_eq!(audit.findings.iter().map(|finding| &*finding.numbers).collect::<Vec<_>>(), ["o.w"]);
}

#[test]
fn undefined_values_are_tracked_through_calls() {
    let half = "struct S { float a; float b; };\nS f() { S s; s.a = 1.; return s; }\n";
    for (functions, body, part) in [
        // A local that is returned before it is written.
        ("float f() { float a; return a; }\n", "o = vec4(f() + 1.);", "a"),
        ("float f() { float a; return a; }\nfloat g() { return f(); }\n", "o = vec4(g() + 1.);", "a"),
        // Some paths through a function have no return.
        ("float f(float x) { if (x > 4.) return 1.; }\n", "o = vec4(f(p.x) + 1.);", "f()"),
        // A structure that is filled in part.
        (half, "o = vec4(f().b + 1.);", "s.b"),
        ("float f(vec2 v) { return v.y - 1.; }\n", "vec2 v;\nv.x = 1.;\no = vec4(f(v));", "v.y"),
        ("vec3 f() { vec3 c; return c; }\n", "o = vec4(f(), 1.);", "c"),
    ] {
        let code = format!("{functions}{}", image(body));
        let audit = audited(&code);
        assert_eq!(audit.findings.iter().map(|f| &*f.numbers).collect::<Vec<_>>(), [part], "{code}");
        assert!(audit.findings[0].span.is_some_and(|span| part.starts_with(&code[span.range()])), "{code}");
    }
    for (functions, body) in [
        (half, "o = vec4(f().a + 1.);"),
        ("float f(vec2 v) { return v.x - 1.; }\n", "vec2 v;\nv.x = 1.;\no = vec4(f(v));"),
        ("float f() { float a; a = 2.; return a; }\n", "o = vec4(f() + 1.);"),
        ("float f() { float a; return a; }\nfloat g() { f(); return 1.; }\n", "o = vec4(g() + 1.);"),
        ("void f() { float a; }\nfloat g() { float a; return a; }\n", "g();\nf();\no = vec4(1.);"),
    ] {
        let code = format!("{functions}{}", image(body));
        assert_eq!(named(&code, &audited(&code)), [], "{code}");
    }
}

#[test]
fn undefined_results_are_listed_with_their_operands() {
    for (body, text, numbers) in [
        ("o = vec4(pow(p.x - 9., 2.));", "pow(p.x - 9., 2.)", "pow(-8.5, 2.0)"),
        ("o = vec4(normalize(p - p), 0., 1.);", "normalize(p - p)", "normalize(0.0, 0.0)"),
        ("o = vec4(smoothstep(p.x, .25, .5));", "smoothstep(p.x, .25, .5)", "smoothstep(0.5, 0.25, …)"),
        ("o = vec4(1 << (int(p.x) + 32));", "1 << (int(p.x) + 32)", "… by 32"),
        ("o = vec4(int(p.x * 1e10));", "int(p.x * 1e10)", "int(5000000000.0)"),
        ("o = vec4(uint(p.x - 9.));", "uint(p.x - 9.)", "uint(-8.5)"),
        ("o = vec4((p.x - .5) / (p.x - .5));", "(p.x - .5) / (p.x - .5)", "0.0 / 0.0"),
        ("o = vec4(7 / (int(p.x) - 3));", "7 / (int(p.x) - 3)", "… / 0"),
        ("o = vec4(sqrt(p.x - 9.));", "sqrt(p.x - 9.)", "sqrt(-8.5)"),
        ("float a[3] = float[3](1., 2., 3.);\no = vec4(a[int(p.x)]);", "a[int(p.x)]", "[3] of 3"),
        ("o = texelFetch(iChannel0, ivec2(p), 0);", "texelFetch(iChannel0, ivec2(p), 0)", "[1, 0], 0) of 1x1"),
        ("o = vec4(atan(p.x - .5, 0.));", "atan(p.x - .5, 0.)", "atan(0.0, 0.0)"),
        ("o = vec4(clamp(p.x, 1., p.y - 9.));", "clamp(p.x, 1., p.y - 9.)", "clamp(…, 1.0, -8.5)"),
    ] {
        let code = image(body);
        let audit = audited(&code);
        let found = audit.findings.iter().find(|f| f.kind.name() == "undefined");
        let found = found.unwrap_or_else(|| panic!("{body}: {:?}", named(&code, &audit)));
        assert_eq!(found.span.map(|span| &code[span.range()]), Some(text), "{body}");
        assert!(found.numbers.contains(numbers), "{body}: {}", found.numbers);
    }
}

/// GLSL ES 3.00, sections 8.8 and 8.9: within non-uniform control flow. Neighbours diverge by columns of two, or not at
/// all if the edge is between blocks of two by two.
#[test]
fn derivatives_in_non_uniform_control_flow_are_listed() {
    let read = "texture(iChannel0, p / 8.)";
    let listed = |code: &str, filter: Filter| {
        let project = Project::of_image("Untitled".into(), code.into());
        let mut inputs = inputs();
        let level =
            |width| TextureLevel { width, height: width, depth: 1, texels: vec![[0.5; 4]; (width * width) as usize] };
        (inputs.channels[0].levels, inputs.channels[0].filter) = (vec![level(2), level(1)], filter);
        let pixels: Vec<(u32, u32)> = (0..8).map(|x| (x, 1)).collect();
        let audit = audit(&Sources::new(&project), 0, &inputs, &pixels, STEPS).unwrap();
        let findings = audit.findings.iter().filter(|f| f.kind.message().contains("neighbouring pixels do not share"));
        findings.map(|f| (code[f.span.unwrap().range()].to_owned(), f.pixels)).collect::<Vec<_>>()
    };
    let image = |condition: &str, value: &str| image(&format!("o = vec4(0.);\nif ({condition}) o += {value};"));
    for (condition, value, pixels) in [
        ("p.x < 3.", "dFdx(p.x)", 1),
        ("p.x > 3.", "fwidth(p.y)", 1),
        ("p.x < 3.", read, 1),
        ("p.x < 3.", "texture(iChannel0, p / 8., 1.)", 1),
        ("p.y < 1.", read, 0),
        ("p.y > 1.", read, 8),
    ] {
        let expected: Vec<(String, usize)> = (pixels > 0).then(|| (value.to_owned(), pixels)).into_iter().collect();
        assert_eq!(listed(&image(condition, value), Filter::Mipmap), expected, "{condition} {value}");
    }
    for (condition, value, filter) in [
        ("p.x < 4.", "dFdx(p.x)", Filter::Mipmap),
        ("iTime > 0.", read, Filter::Mipmap),
        ("p.x < 3.", "textureLod(iChannel0, p / 8., 0.)", Filter::Mipmap),
        ("p.x < 3.", "textureGrad(iChannel0, p / 8., p, p)", Filter::Mipmap),
        // Only one level is read.
        ("p.x < 3.", read, Filter::Linear),
    ] {
        assert_eq!(listed(&image(condition, value), filter), [], "{condition} {value}");
    }
}

/// Folded operations are not executed: they are found statically.
#[test]
fn constants_are_listed_too() {
    for (expression, kind) in [
        ("int(1e20)", "undefined"),
        ("uint(-3.0)", "undefined"),
        ("ivec2(0., 3e9)", "undefined"),
        ("0.0 / 0.0", "undefined"),
        ("1.0 / 0.0", "nonfinite"),
        ("mod(vec2(1), 0.)", "undefined"),
        ("asin(2.)", "undefined"),
        ("inversesqrt(0.)", "undefined"),
        ("atan(0., 0.)", "undefined"),
        ("normalize(vec3(0))", "undefined"),
        ("pow(-1., .5)", "undefined"),
        ("sqrt(-1.)", "undefined"),
        ("log(0.)", "undefined"),
        ("clamp(1., 2., 1.)", "undefined"),
        ("smoothstep(1., 0., .5)", "undefined"),
        ("1 << 40", "undefined"),
        ("5 / 0", "undefined"),
        ("5 % 0", "undefined"),
    ] {
        let code =
            image(&format!("o = vec4({expression});")).replace("vec4(ivec2(0., 3e9))", "vec4(ivec2(0., 3e9), 0, 1)");
        let code = code.replace("vec4(mod(vec2(1), 0.))", "vec4(mod(vec2(1), 0.), 0, 1)");
        let code = code.replace("vec4(normalize(vec3(0)))", "vec4(normalize(vec3(0)), 1)");
        let audit = audited(&code);
        assert_eq!(named(&code, &audit), [(kind, expression)], "{expression}");
        assert!(audit.findings[0].is_constant() && audit.findings[0].pixels == 32, "{expression}");
    }
    // Defined cases: the ends of the ranges, infinities of infinities, NaN of NaN, and bits that represent one.
    for expression in
        ["int(-2147483648.)", "uint(4294967040.)", "uint(-.5)", "uintBitsToFloat(0x7fc00000u)", "uint(-1)"]
    {
        let code = image(&format!("o = vec4({expression});"));
        assert_eq!(named(&code, &audited(&code)), [], "{expression}");
    }
    let code = image("const float inf = 1. / 0.;\nconst float nan = inf - inf;\no = vec4(inf * 2., nan + 1., 0., 1.);");
    assert_eq!(named(&code, &audited(&code)), [("nonfinite", "1. / 0."), ("undefined", "inf - inf")]);
}

#[test]
fn nan_is_reported_at_its_origin_only() {
    let code = image("float a = p.x - p.x;\nfloat b = a / a;\nfloat c = b + 1.;\no = vec4(c * 2.);");
    let audit = audited(&code);
    let nonfinite: Vec<_> = audit.findings.iter().filter(|f| f.kind.name() == "nonfinite").collect();
    assert_eq!(nonfinite.len(), 1, "{:?}", named(&code, &audit));
    assert_eq!((&code[nonfinite[0].span.unwrap().range()], nonfinite[0].pixels), ("a / a", 32));
}

#[test]
fn comparison_decided_by_rounding_is_reported() {
    let code = image("float a = p.x * .1;\no = vec4(a * 3. == p.x * .3 ? 1. : 0.);");
    assert!(named(&code, &audited(&code)).iter().any(|(kind, _)| *kind == "decided-by-rounding"));
}

#[test]
fn undefined_evaluation_order_is_reported_for_the_pixels_that_reach_it() {
    const SEED: &str = "float seed;\nfloat next() { seed = fract(seed * 7.1 + .3); return seed; }\n\
                        float pure(float x) { return x * seed; }\n\
                        void pair(out float a, inout float b) { a = 1.; b = 2.; }\n";
    for (body, text, pixels) in [
        ("float r = 0.;\nif (p.x < 2.) r = next() - next();\no = vec4(r);", "next() - next()", 8),
        ("o = vec4(next() * 2. + pure(p.x));", "next() * 2. + pure(p.x)", 32),
        ("int i = 1;\no = vec4(i + i++);", "i + i++", 32),
        ("int i = 1;\no = vec4((i = 3) < i);", "(i = 3) < i", 32),
        ("float a[3];\nint i = 0;\na[1] = 2.;\npair(a[i++], a[1]);\no = vec4(a[0]);", "pair(a[i++], a[1])", 32),
        ("vec3 v;\npair(v.x, v.x);\no = vec4(v, 1.);", "pair(v.x, v.x)", 32),
    ] {
        let code = format!("{SEED}{}", image(body));
        let audit = audited(&code);
        let orders = audit.findings.iter().filter(|f| f.kind.message().contains("their order is undefined"));
        let found: Vec<_> = orders.map(|f| (&code[f.span.unwrap().range()], f.pixels)).collect();
        assert_eq!(found, [(text, pixels)], "{body}");
    }
    // The order is defined, or there is nothing to order.
    for body in [
        "o = vec4(vec2(next(), next()), max(next(), next()), 1.);",
        "int i = 1;\nbool b = i++ > 0 && i == 2;\no = vec4(b ? i++ : i--, (i++, i), 0., 1.);",
        "float a = next();\no = vec4(a + next());",
        "float a[2];\nint i = 0;\na[i++] = float(i);\no = vec4(a[0]);",
        "vec3 v;\npair(v.x, v.y);\no = vec4(v, p.x + pure(p.x) * pure(p.y));",
    ] {
        let code = format!("{SEED}{}", image(body));
        let audit = audited(&code);
        let orders = audit.findings.iter().filter(|f| f.kind.message().contains("their order is undefined"));
        assert_eq!(orders.count(), 0, "{body}: {:?}", named(&code, &audit));
    }
}
