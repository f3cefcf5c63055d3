//! The order in which operands and arguments are evaluated, and when variables among them are read: each case is one
//! texel of a buffer, as in [`glsl_compute`](super::glsl_compute).

use crate::support::compute::*;

#[test]
fn side_effects_happen_in_order_of_evaluation() {
    check(&[
        case("int i = 0; int a = i++ + i++ * 10 + i; r = vec4(a, i, 0, 0);", [12., 2., 0., 0.]),
        with(
            "int g = 0; int f() { g += 1; return g; }",
            "int a = g + f() + g; r = vec4(a, g, 0, 0);",
            [3., 1., 0., 0.],
        ),
        with(
            "int g = 0; bool t() { g++; return true; } bool f() { g += 10; return false; }",
            "bool a = f() && t(); bool b = t() || f(); r = vec4(a, b, g, 0);",
            [0., 1., 11., 0.],
        ),
        with(
            "int g = 0; bool t() { g++; return true; }",
            "bool a = I > 5 && t(); a = I == 0 || t(); r = vec4(a, g, 0, 0);",
            [1., 0., 0., 0.],
        ),
        with(
            "int g = 0; float f(float x) { g++; return x; }",
            "float a = I == 0 ? f(2.0) : f(3.0); r = vec4(a, g, 0, 0);",
            [2., 1., 0., 0.],
        ),
        case(
            "int i = 0; float a[3] = float[3](1.0, 2.0, 3.0); a[i++] += 10.0; r = vec4(a[0], a[1], a[2], i);",
            [11., 2., 3., 1.],
        ),
        case("int i = 0; vec3 v = vec3(1, 2, 3); v[i++] = v[i++] + 5.0; r = vec4(v, i);", [7., 2., 3., 2.]),
        case("vec2 v = vec2(1, 2); v.xy = v.yx; r = vec4(v, (v.x = 9.0, v.y), v.x);", [9., 1., 1., 9.]),
        case("float a = 1.0, b = 2.0; a += b *= 3.0; r = vec4(a, b, a == 7.0 ? 1 : 0, 0);", [7., 6., 1., 0.]),
        case("int i = 5; r = vec4(i--, --i, i++, ++i);", [5., 3., 3., 5.]),
        with(
            "bool b3(out int x) { x = 4; return true; }",
            "int n = 1; if (b3(n) && n == 4) r = vec4(n); else r = vec4(0);",
            [4.; 4],
        ),
    ]);
}

/// An operand or argument that is a variable, or a part of one, is read after all others have been evaluated. The
/// numbers are those of Chromium with two back ends of ANGLE, SPIR-V and OpenGL, which agree except where a comment
/// says so.
#[test]
fn variables_among_operands_are_read_last() {
    const HEAD: &str = "float g; vec2 v; float a[2]; struct S { float x; }; S s; struct T { float a; float b; };
        float f() { g += 10.; return 1.; } float fv() { v += 10.; return 1.; } vec2 fv2() { v += 10.; return vec2(1.); }
        float fa() { a[1] += 10.; return 1.; } float fs() { s.x += 10.; return 1.; }
        float fo(inout float x) { x += 10.; return 1.; } float two(float x, float y) { return x + 0. * y; }
        float ti(inout float x, float y) { return x + 0. * y; } float ta(float q[2], float y) { return q[1] + 0. * y; }
        float tai(inout float q[2], float y) { return q[1] + 0. * y; } float ts(S q, float y) { return q.x + 0. * y; }";
    let cases = [
        ("r = vec4(0.); g = 1.; r.x = g * f();", 11.),
        ("r = vec4(0.); g = 1.; r.x = g + f();", 12.),
        ("r = vec4(0.); g = 1.; r.x = (g) * f();", 11.),
        ("r = vec4(0.); g = 1.; r.x = g < f() ? 1. : 2.;", 2.),
        ("r = vec4(0.); g = 1.; r.x = g == f() + 10. ? 1. : 2.;", 1.),
        ("r = vec4(0.); g = 1.; r.x = g * (Z < 1. ? f() : 0.);", 11.),
        ("r = vec4(0.); g = 1.; r.x = g + g * f();", 22.),
        ("r = vec4(0.); g = 1.; r.x = g + f() + g;", 23.),
        ("r = vec4(0.); g = 1.; r.x = g; r.x += f() * g;", 12.),
        ("r = vec4(0.); g = 1.; g += f(); r.x = g;", 12.),
        ("r = vec4(0.); g = 1.; r.x = vec2(g, f()).x;", 11.),
        ("r = vec4(0.); g = 1.; r.x = two(g, f());", 11.),
        ("r = vec4(0.); g = 1.; r.x = ti(g, f());", 11.),
        ("r = vec4(0.); g = 1.; r.x = max(g, f() * 0.);", 11.),
        ("r = vec4(0.); g = 1.; r.x = mix(g, f(), 0.);", 11.),
        ("r = vec4(0.); g = 1.; float q[2] = float[2](g, f()); r.x = q[0];", 11.),
        ("r = vec4(0.); g = 1.; T t = T(g, f()); r.x = t.a;", 11.),
        ("r = vec4(0.); v = vec2(1., 5.); r.x = v.x * fv();", 11.),
        ("r = vec4(0.); v = vec2(1., 5.); r.x = (v * fv2()).x;", 11.),
        ("r = vec4(0.); v = vec2(1., 5.); r.x = (v.yx * fv()).y;", 11.),
        ("r = vec4(0.); v = vec2(1., 5.); r.x = v[I] * fv();", 11.),
        ("r = vec4(0.); v = vec2(1., 5.); r.x = mat2(v, fv2())[0].x;", 11.),
        ("r = vec4(0.); a[1] = 1.; r.x = a[1] * fa();", 11.),
        ("r = vec4(0.); a[1] = 1.; r.x = ta(a, fa());", 11.),
        ("r = vec4(0.); a[1] = 1.; r.x = tai(a, fa());", 11.),
        ("r = vec4(0.); s.x = 1.; r.x = s.x * fs();", 11.),
        ("r = vec4(0.); s.x = 1.; r.x = ts(s, fs());", 11.),
        ("r = vec4(0.); float l = 1.; r.x = l * (l += 1.);", 4.),
        ("r = vec4(0.); float l = 1.; r.x = l + l++;", 3.),
        ("r = vec4(0.); float l = 1.; r.x = l * ++l;", 4.),
        ("r = vec4(0.); float l = 1.; r.x = l * fo(l);", 11.),
        ("r = vec4(0.); float l = 1.; r.x = ti(l, l += 1.);", 2.),
        ("r = vec4(0.); mat2 m = mat2(1., 2., 3., 4.); r.x = m[0][1] * (m[0][1] += 10.);", 144.),
        ("r = vec4(0.); int n = 1; r.x = vec2(n, n += 3).x;", 4.),
        ("r = vec4(0.); int n = 1; r.x = mat2(n, n += 3, n, n)[0].x;", 4.),
        // Other operands are evaluated immediately: a conversion, for which OpenGL returns 4, and an index.
        ("r = vec4(0.); int n = 1; r.x = vec2(float(n), float(n += 3)).x;", 1.),
        ("r = vec4(0.); int n = 0; a[0] = 7.; a[1] = 9.; r.x = a[n] * float(++n);", 7.),
        ("r = vec4(0.); int n = 0; v = vec2(3., 5.); r.x = v[n] + float(n += 1) * 10.;", 13.),
    ];
    check(&cases.map(|(code, x)| with(HEAD, code, [x, 0., 0., 0.])));
}
