//! Variables that code writes: they are split into scalars and not zeroed needlessly, and keep their values.

use crate::support::{compute::*, ir};
use eddy::glsl::Driver;

/// Returns the declared variables and globals of each program, below the text that is special to it.
fn declared<'a>(programs: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let texts = programs.into_iter().map(|(name, code)| {
        let declarations = ir::declarations(&ir::optimised(&code, Driver::default()));
        format!("; {name}\n{declarations}\n")
    });
    texts.collect()
}

#[test]
fn variables_have_their_written_values() {
    const STATE: &str = "struct S { vec2 a; float b; ivec2 c; }; struct T { S s; mat2 m; S t; };\n\
        void both(inout vec3 v, out mat2 m) { v.x += 1.0; m[1] = v.yz; if (v.x > 99.0) discard; v = v.zxy; }";
    check(&[
        case(
            "vec4 v = vec4(1, 2, 3, 4); for (int i = 0; i < I + 3; i++) { v = v.yzwx; v.xw += v.wx; } r = v;",
            [10., 3., 6., 10.],
        ),
        case(
            "vec2 a = vec2(1, 2), b = a; if (I == 0) { b = a.yx; a = b + 1.0; } else b = vec2(9); r = vec4(a, b);",
            [3., 2., 2., 1.],
        ),
        case(
            "mat3x2 m; for (int i = 0; i < I + 2; i++) { m[2].yx += vec2(i, 1); m[i] = m[2]; } r = vec4(m[0].x, m[1], \
             m[2].y);",
            [1., 2., 1., 1.],
        ),
        case(
            "bvec3 b = bvec3(true); uvec2 u = uvec2(7, 8); for (int i = 0; i < I + 2; i++) { b.y = !b.y; b.z = i > 0 \
             && b.y; u = u.yx + 1u; }\n\
             r = vec4(b, u.y);",
            [1., 1., 1., 10.],
        ),
        with(
            STATE,
            "T t; t.s.b = 3.0; t.t = t.s; t.t.c.y = I + 4; t.m[1].y = t.t.b; T u = t; for (int i = 0; i < I + 2; i++) \
             u.s.a += u.m[1];\n\
             S s = u.t; r = vec4(s.b, s.c, u.s.a.y);",
            [3., 0., 4., 6.],
        ),
        with(
            STATE,
            "vec3 v = vec3(1, 2, 3); mat2 m = mat2(9); both(v, m); vec3 w = v; both(v, m); r = vec4(v, m[1].x + m[0].x \
             + w[I]);",
            [2., 4., 2., 5.],
        ),
        case("vec3 v = vec3(1, 2, 3); if (I == 0) v[I + 1] = 5.0; v.z += v[I + 1]; r = v.xyzz;", [1., 5., 8., 8.]),
    ]);
}

/// A variable that each call fills exists once, and is zeroed once.
#[test]
fn what_is_filled_before_it_is_read_needs_no_zeros() {
    let programs = [
        "mat2 m = mat2(p, p.yx); x = m[i].y;",
        "x = mat2(p, p.yx)[i].y;",
        "x = element(float[](p.x, p.y, 3.0), i);",
        "for (int k = 0; k < i; k++) { float a[2] = float[](x, p.y); a[k] += 1.0; x += a[k & 1]; }",
        // A zero is read, or would be on another path.
        "float a[2]; a[i] = p.x; x = a[i + 1];",
        "float a[2]; if (i > 1) a = float[](p.x, p.y); x = a[i];",
        "float a[2]; while (x < 9.0) { x += a[i] + 1.0; a = float[](p.x, p.y); }",
    ];
    let code = |body: &str| {
        format!(
            "float element(float a[3], int i) {{ return a[i]; }}\n\
             float f(vec2 p, int i) {{ float x = p.x; {body} if (i > 7) discard; return x; }}\n\
             void mainImage(out vec4 o, vec2 p) {{ o = vec4(f(p, int(p.y)), f(p, 1), 0, 1); }}"
        )
    };
    insta::assert_snapshot!(declared(programs.map(|body| (body, code(body)))));
    check(&[with(
        "float f(float x, int i) { if (i > 7) discard; float a[2]; if (i > 0) a = float[](x, 2.0); return a[i & 1]; }\n\
         float g(float x, int i) { if (i > 7) discard; float a[2] = float[](x, 2.0); a[i] += 1.0; return a[i] + \
         f(a[i], i + 1); }",
        "r = vec4(f(5.0, I + 2), f(5.0, I), g(1.0, I), g(3.0, I + 1));",
        [5., 0., 4., 6.],
    )]);
}

/// A driver that recompiles shaders for the values of uniforms must not see through them. The code that hides them
/// would cost time in every iteration of a loop.
#[test]
fn hidden_uniforms_are_read_before_loops() {
    let driver = Driver { opaque_uniforms: true, ..Driver::default() };
    insta::assert_snapshot!(ir::optimised(
        "void mainImage(out vec4 o, vec2 p) {\n\
             o = vec4(0); for (int i = 0; i < int(p.x); i++) { o.x += iTime; if (o.x > 9.0) o.yz += iResolution.xy * \
             iTime; }\n\
         }",
        driver,
    ));
}
