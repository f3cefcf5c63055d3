//! Declarations, qualifiers and expressions of versions of GLSL after ES 3.00, in complete fragment shaders.

use super::later::{LATER, of_statements};
use crate::{Alpha, Dialect, PassKind, PassSource, Text, compile, diagnose};
use eddy_diag::{Diagnostic, SourceId};

fn source(text: &str) -> PassSource<'_> {
    PassSource { dialect: LATER, ..PassSource::new(PassKind::Main(Alpha::Opaque), Text { id: SourceId(0), text }) }
}

/// Returns the messages about a fragment shader with declarations and statements, the errors first.
fn said(declarations: &str, statements: &str) -> Vec<Diagnostic> {
    let text = format!(
        "#version 450\nout vec4 color;\n{declarations}\nvoid main() {{ vec2 p = gl_FragCoord.xy; {statements} }}\n"
    );
    let mut said = diagnose(&source(&text));
    said.sort_by_key(|diagnostic| !diagnostic.is_error());
    if said.iter().all(|diagnostic| !diagnostic.is_error()) {
        compile(&source(&text)).unwrap_or_else(|found| panic!("{text}: {found:?}"));
    }
    said
}

#[track_caller]
fn assert_accepted(declarations: &str, statements: &str) {
    let said = said(declarations, statements);
    assert!(said.is_empty(), "{declarations} {statements}: {said:?}");
}

/// Checks the only error, and that it has a hint with these words.
#[track_caller]
fn assert_rejected(declarations: &str, statements: &str, message: &str, hint: &str) {
    let said = said(declarations, statements);
    let errors: Vec<&Diagnostic> = said.iter().filter(|diagnostic| diagnostic.is_error()).collect();
    assert_eq!(errors.iter().map(|error| error.message.as_str()).collect::<Vec<_>>(), [message], "{declarations}");
    assert!(hint.is_empty() || errors[0].hints.iter().any(|found| found.contains(hint)), "{:?}", errors[0].hints);
}

#[test]
fn precise_and_sample_are_qualifiers_or_names() {
    assert_accepted(
        "precise float g; struct S { vec2 v; }; precise S s; float h(precise float x, precise out float y) { y = x; return x; }",
        "precise vec4 c = vec4(1.0); float z; precise z; const precise float k = 2.0; s.v = p; g = h(1.0, z); color = c * g * k * z * s.v.x;",
    );
    assert_accepted(
        "float precise; vec2 sample(float noperspective) { return vec2(noperspective); }",
        "precise = 2.0; color = vec4(sample(precise), 0, 1);",
    );
    assert_accepted("struct precise { float a; };", "precise f; f.a = 2.0; color = vec4(f.a);");
    for qualified in ["sample in", "noperspective in", "in", "sample flat in"] {
        let said = said(&format!("{qualified} vec2 at;"), "color = vec4(at, 0, 1);");
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].message.contains("no vertex shader sets it"), "{said:?}");
    }
}

#[test]
fn layouts_of_later_versions_are_accepted() {
    for declaration in [
        "layout(early_fragment_tests) in;",
        "layout(depth_greater) out float gl_FragDepth;",
        "out float gl_FragDepth;",
        "in vec4 gl_FragCoord;",
        "layout(origin_upper_left) in vec4 gl_FragCoord;",
        "layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;",
        "layout(blend_support_all_equations) out;",
    ] {
        assert_accepted(declaration, "gl_FragDepth = 0.5; color = gl_FragCoord;");
    }
    assert_rejected("in vec3 gl_FragCoord;", "", "`gl_FragCoord` can only be declared as `in vec4 gl_FragCoord`", "");
    assert_rejected("in vec4 gl_FragCoords;", "", "`gl_FragCoords`: names that start with `gl_` are reserved", "");
    assert_rejected("layout(rgba99) in vec4 at;", "", "GLSL ES 3.00 has no layout `rgba99`", "");
    let said = said("in Vertex { flat int n; vec2 at; } v;", "color = vec4(v.at, v.n, 1);");
    assert_eq!(said[0].message, "the block `Vertex` has no values (0): no vertex shader sets them");
}

#[test]
fn lists_initialise_matrices_and_structs() {
    assert_accepted(
        "struct A { vec2 a; float b[2]; }; struct B { A a; mat2 m; }; const B ALL[2] = { {{{1, 2}, {3, 4}}, {{5, 6}, {7, 8}}}, {{{1, 2}, {3, 4}}, {{5, 6}, {7, 9}}} };",
        "mat2x3 m = {{1, 2, 3}, {4, 5, 6}}; const float x = ALL[1].m[1][1]; float a[int(x)]; color = vec4(a.length() - 8, m[1][2], ALL[0].a.b[1], 1);",
    );
    assert!(!said("", "mat2 m = {{1, 2, 3}, {4, 5}}; color = vec4(m[0], m[1]);").is_empty());
}

#[test]
fn scalars_have_components_and_all_have_a_length() {
    assert_accepted(
        "",
        "float f = p.x; f.x += 1.0; color = f.xxxx; vec3 v = f.rrr * p.x.sss; mat2x3 m; const int n = v.length() + m.length() + m[0].length(); float a[n]; color.x = a[7].x;",
    );
    assert!(!of_statements(Dialect::Shadertoy, "float f = p.x; c = f.xxxx;").is_empty());
    assert_rejected("", "color = vec4(p.x.y);", "a `float` has no `.y`", "");
}

#[test]
fn mixtures_of_whole_numbers_choose() {
    assert_accepted(
        "",
        "ivec2 i = mix(ivec2(1), ivec2(p), bvec2(true, false)); uint u = mix(1u, uint(p.x), p.y > 1.0); bool b = mix(true, p.x > 2.0, p.y > 1.0); \
         const int n = mix(2, 3, true); float a[n]; color = vec4(i, u, b) + a[2];",
    );
    let shadertoy = "int i = mix(1, 2, true); c = vec4(i);";
    assert!(!of_statements(Dialect::Shadertoy, shadertoy).is_empty());
    assert!(!of_statements(Dialect::Ghostty, shadertoy).is_empty());
}

#[test]
fn interpolants_move_and_constants_of_later_versions_exist() {
    assert_eq!(said("in vec2 at;", "color = vec4(interpolateAtCentroid(at), interpolateAtOffset(at, vec2(0.5)) + interpolateAtSample(at, gl_SampleID));").len(), 1);
    assert_accepted("const int n = gl_MaxTextureUnits;", "color = vec4(n, gl_NumSamples, gl_PrimitiveID, 1);");
}

#[test]
fn unsupported_features_are_named() {
    assert_rejected(
        "double d;",
        "color = vec4(float(d));",
        "`double` is not supported: Eddy computes in 32-bit floats",
        "write `float`",
    );
    assert_rejected(
        "",
        "dvec3 d = dvec3(1.0); color = vec4(d, 1.0);",
        "`dvec3` is not supported: Eddy computes in 32-bit floats",
        "write `vec3`",
    );
    assert_rejected(
        "dmat4 m;",
        "color = vec4(1.0);",
        "`dmat4` is not supported: Eddy computes in 32-bit floats",
        "write `mat4`",
    );
    assert_rejected("", "color = vec4(1.0lf);", "`1.0lf` is not a number", "write `1.0`");
    assert_rejected(
        "layout(std430, binding = 0) buffer B { float x[]; };",
        "color = vec4(1.0);",
        "shader storage blocks are not supported",
        "texture",
    );
    assert_rejected(
        "readonly buffer B { float x[]; } b;",
        "color = vec4(1.0);",
        "shader storage blocks are not supported",
        "texture",
    );
    assert_rejected("subroutine vec4 T(float x);", "color = vec4(1.0);", "subroutines are not supported", "switch");
    assert_rejected(
        "subroutine(T) vec4 f(float x) { return vec4(x); }",
        "color = vec4(1.0);",
        "subroutines are not supported",
        "switch",
    );
    assert_rejected(
        "uniform atomic_uint n;",
        "color = vec4(1.0);",
        "`atomic_uint` is not supported: Eddy has no atomic counters",
        "buffer",
    );
    assert_rejected(
        "uniform uimage2D i;",
        "color = vec4(1.0);",
        "`uimage2D` is not supported: Eddy has no images that shaders write",
        "texelFetch",
    );
    assert_rejected(
        "layout(rgba8) uniform image2D i;",
        "color = vec4(1.0);",
        "`image2D` is not supported: Eddy has no images that shaders write",
        "texelFetch",
    );
    assert_rejected(
        "uniform readonly image2D i;",
        "color = vec4(1.0);",
        "images that shaders write are not supported",
        "texelFetch",
    );
    assert_rejected(
        "",
        "memoryBarrier(); color = vec4(1.0);",
        "`memoryBarrier` is not supported: Eddy has no memory that shaders share",
        "",
    );
    assert_accepted(
        "float buffer; float subroutine(float image2D) { return image2D; }",
        "buffer = subroutine(1.0); color = vec4(buffer);",
    );
}

#[test]
fn arrays_have_arrays() {
    assert_accepted(
        "float a[3][2] = {{1, 2}, {3, 4}, {5, 6}}; float f(float x[3][2], out float[2] y[3]) { y = x; return x[2][1]; } float[2][2] g() { return float[2][2](float[2](1, 2), float[](3, 4)); }",
        "float b[3][2]; const float c[][] = float[][](float[](1.0, 2.0), float[](3.0, 4.0)); float d[][2] = {{1, 2}, {3, 4}}; float n[a.length()][c[0].length()]; n = a; \
         int i = int(p.x) & 1; b[i][1 - i] = c[1][1]; d[i] = float[](7.0, 8.0); color = vec4(f(a, b), g()[1][i], d[1][i], n == a ? c[i][i] : b[2][i]);",
    );
    for (wrong, message) in [
        ("float[3][2] a; float b[2][3] = a;", "cannot initialise the `float[2][3]` `b` with `float[3][2]`"),
        ("float a[2][];", "`a` needs a size between the brackets, or an initialiser that is an array"),
        ("float a[2][2] = {{1, 2}, {3}};", "an element of `float[][2]` cannot be `float[1]`"),
        ("float a[2][2] = float[3][2](float[](1, 2));", "`float[3][2]` needs 3 arguments, 1 is given"),
        (&format!("float a{};", "[1]".repeat(20_000)), "an array can have at most 16 dimensions"),
        (&format!("float a{0} = float{0}(p.x);", "[1]".repeat(17)), "an array can have at most 16 dimensions"),
        ("float a[3000][3000];", "this array takes 35 MiB; the limit is 16 MiB"),
        ("float f[2]; float a[2][2] = f;", "cannot initialise the `float[2][2]` `a` with `float[2]`"),
        ("float[3] a[2]; a[2][0] = 1.0;", "index 2 is out of range: `float[2][3]` has 2 elements, 0 to 1"),
        ("float a[2][2]; a[0][2] = 1.0;", "index 2 is out of range: `float[2]` has 2 elements, 0 to 1"),
    ] {
        let said = said("", &format!("{wrong} color = vec4(1.0);"));
        assert!(said.iter().any(|d| d.is_error() && (message.is_empty() || d.message == message)), "{wrong}: {said:?}");
    }
    let said = of_statements(Dialect::Shadertoy, "float a[2][2]; c = vec4(1);");
    assert_eq!(said, ["GLSL ES 3.00 has no arrays of arrays"]);
}

#[test]
fn long_arrays_of_arrays_are_in_buffers() {
    let list = |count: usize, of: &dyn Fn(usize) -> String| (0..count).map(of).collect::<Vec<_>>().join(" ");
    let rows = list(20, &|i| format!("{{{}}},", list(20, &|j| format!("{i}.{j},"))));
    let stores = list(400, &|i| format!("t[{}][{}].v = vec2({i}, p.x * 0.0 + 1.0);", i / 20, i % 20));
    let constants = stores.replace("p.x * 0.0 + 1.0", "1.0");
    for (declarations, statements, bytes) in [
        (format!("const float t[20][20] = {{{rows}}};"), "c = vec4(t[i][j]);".to_owned(), 20 * 20 * 4),
        ("struct S { vec2 v; }; S t[20][20];".to_owned(), format!("{constants} c = t[i][j].v.xyxy;"), 20 * 20 * 8),
        ("struct S { vec2 v; }; S t[20][20];".to_owned(), format!("{stores} c = t[i][j].v.xyxy;"), 0),
    ] {
        let text = format!(
            "{declarations} void mainImage(out vec4 c, in vec2 p) {{ int i = int(p.x), j = int(p.y); {statements} }}"
        );
        for array_loops in [false, true] {
            let mut source = PassSource { kind: PassKind::Buffer, ..source(&text) };
            source.driver.array_loops = array_loops;
            let compiled = compile(&source).unwrap_or_else(|errors| panic!("{errors:?}"));
            compiled.validate().unwrap_or_else(|error| panic!("{error:?}"));
            assert_eq!(compiled.tables.len(), bytes, "{declarations}");
        }
    }
}
