//! The values that compiled programs compute, tested by pictures: each case is one texel of a buffer.
//!
//! `Z`, `I` and `U` are zeros that a compiler cannot see through, so that constant folding does not apply.

use crate::support::compute::*;

const INF: f32 = f32::INFINITY;
const NAN: f32 = f32::NAN;

#[test]
fn infinities_and_nan_are_kept() {
    check(&[
        case("r = vec4(1.0 / 0.0, -1.0 / 0.0, 0.0, 1.0);", [INF, -INF, 0.0, 1.0]),
        case("float n = uintBitsToFloat(0x7fc00000u); r = vec4(isnan(n), n == n, n != n, isinf(n));", [1., 0., 1., 0.]),
        case(
            "float n = uintBitsToFloat(0x7fc00000u + U); r = vec4(isnan(n), n == n, n != n, n < 1.0);",
            [1., 0., 1., 0.],
        ),
        case("float i = 1.0 / Z; r = vec4(isinf(i), isnan(i), isinf(-i), i > 3e38);", [1., 0., 1., 1.]),
        case("r = vec4(equal(vec2(Z / Z), vec2(0.0)), notEqual(vec2(Z / Z, 1.0), vec2(0.0, 1.0)));", [0., 0., 1., 0.]),
        case("vec2 n = vec2(Z / Z, 1.0); r = vec4(n == n, n != n, isnan(n));", [0., 1., 1., 0.]),
        with(
            "const float T[3] = float[3](1.0, uintBitsToFloat(0x7f800000u), 3.0);",
            "r = vec4(T[I], T[I + 1], T[I + 2], T[I + 9]);",
            [1., INF, 3., 3.],
        ),
        with("float g = 1.0 / 0.0;", "r = vec4(g, -g, 0.0, 1.0);", [INF, -INF, 0., 1.]),
        case("r = vec4(Z / Z, 0.0, 0.0, 1.0);", [NAN, 0., 0., 1.]),
    ]);
}

#[test]
fn unwritten_variables_are_zero_as_in_webgl() {
    check(&[
        case("float a; vec3 b; r = vec4(a, b);", [0.; 4]),
        case("for (int i = 0; i < 3; i++) { float a; a += 1.0; r.x = a; } r.yzw = vec3(0.0);", [1., 0., 0., 0.]),
        with("void f(out vec4 v) { v.x += 1.0; }", "r = vec4(5.0); f(r);", [1., 0., 0., 0.]),
        with(
            "void f(out float a[2]) { a[1] += 3.0; }",
            "float a[2] = float[2](7.0, 8.0); f(a); r = vec4(a[0], a[1], 0, 0);",
            [0., 3., 0., 0.],
        ),
        with("float f(float x) { if (x > 0.0) return 2.0; }", "r = vec4(f(1.0), f(-1.0), 0, 0);", [2., 0., 0., 0.]),
        with("vec4 g; float h[3];", "r = g + h[I + 1];", [0.; 4]),
        with("struct S { vec2 a; int b[2]; };", "S s; r = vec4(s.a, s.b[I], s.b[1]);", [0.; 4]),
        with("uniform vec4 mine; in vec2 theirs;", "r = mine + theirs.xxyy + 1.0;", [1.; 4]),
    ]);
}

#[test]
fn globals() {
    check(&[
        with(
            "const float a = 1.0; float b = a + 1.0; vec2 c = vec2(a, 2.0) * 2.0;",
            "c.x += Z; r = vec4(a, b, c);",
            [1., 2., 2., 4.],
        ),
        with("int n = 0; void f() { n++; } ", "f(); f(); r = vec4(n, n++, n, ++n);", [4., 2., 4., 4.]),
        with(
            "mat2 m = mat2(2.0 * (1.0, 3.0, 4.0)); float a = (1.0, 2.0);",
            "r = vec4(m[0], m[1].y, a);",
            [8., 0., 8., 2.],
        ),
        with("float a = 3.0; float b = 6.0; void g() { a = b - 1.0; }", "g(); r = vec4(a, b, 0, 0);", [5., 6., 0., 0.]),
        with("const mat2 m = mat2(1, 2, 3, 4); const vec2 v = m[1];", "r = vec4(v, m[I]);", [3., 4., 1., 2.]),
        with("vec2 res() { return vec2(gl_FragCoord.xy); }", "r = vec4(res(), gl_FragCoord.zw);", [0.5, 0.5, 0.5, 1.0]),
    ]);
}

#[test]
fn parameters_are_copied_in_and_out() {
    check(&[
        // A parameter that is only read has the value that was passed, even if the variable changes meanwhile.
        with(
            "float f(float a[3], inout float b[3]) { b[I + 1] = 9.0; return a[I + 1]; }",
            "float x[3] = float[3](1.0, 2.0, 3.0); r.x = f(x, x); r.y = x[1]; r.zw = vec2(0);",
            [2., 9., 0., 0.],
        ),
        with(
            "float g[3] = float[3](1.0, 2.0, 3.0);\nfloat f(float a[3]) { g[I + 1] = 5.0; return a[I + 1]; }",
            "r = vec4(f(g), g[1], f(g), 0.0);",
            [2., 5., 5., 0.],
        ),
        with(
            "float f(float a[3], float b) { return a[I + 2] + b; }\nfloat h(float a[3]) { return f(a, a[I]); }",
            "float x[3] = float[3](1.0, 2.0, 3.0); r.x = h(x); x[I + 2] = 7.0; r.y = h(x); r.z = f(x, x[2] = 4.0); r.w \
             = f(float[3](6.0, 6.0, 6.0), 1.0);",
            [4., 8., 8., 7.],
        ),
        with(
            "void f(inout float a, inout float b) { a += 1.0; b *= 3.0; }",
            "float x = 2.0; f(x, x); r = vec4(x);",
            [6.; 4],
        ),
        with(
            "void f(inout vec2 v) { v = v.yx + 1.0; }",
            "vec4 a = vec4(1, 2, 3, 4); f(a.wx); r = a;",
            [5., 2., 3., 2.],
        ),
        with(
            "void f(inout float v) { v += 10.0; }",
            "float a[3] = float[3](1.0, 2.0, 3.0); int i = I + 1; f(a[i]); i = 0; r = vec4(a[0], a[1], a[2], i);",
            [1., 12., 3., 0.],
        ),
        with("float g = 1.0; void f(inout float v) { v += 1.0; g += 10.0; }", "f(g); r = vec4(g);", [2.; 4]),
        with("float g = 1.0; float f(float v) { g = 5.0; return v; }", "r = vec4(f(g), g, 0, 0);", [1., 5., 0., 0.]),
        with(
            "struct S { float a; vec2 b; }; void f(inout S s) { s.b.y = 7.0; s.a += 1.0; }",
            "S s = S(1.0, vec2(2.0)); f(s); r = vec4(s.a, s.b, 0);",
            [2., 2., 7., 0.],
        ),
        with(
            "struct S { vec2 b[2]; }; void f(inout vec2 s) { s *= 2.0; }",
            "S s; s.b[1] = vec2(3.0); f(s.b[I + 1]); r = vec4(s.b[0], s.b[1]);",
            [0., 0., 6., 6.],
        ),
        with(
            "void f(float a[2], out float b[2]) { a[0] = 9.0; b = a; }",
            "float a[2] = float[2](1.0, 2.0); float b[2]; f(a, b); r = vec4(a[0], a[1], b[0], b[1]);",
            [1., 2., 9., 2.],
        ),
        with(
            "void f(out mat2 m) { m[1] = vec2(3.0, 4.0); }",
            "mat2 m = mat2(9.0); f(m); r = vec4(m[0], m[1]);",
            [0., 0., 3., 4.],
        ),
        with("void f(out float a, float b) { a = b; }", "float x = 3.0; f(x, x * 2.0); r = vec4(x);", [6.; 4]),
        with("void f(inout float a, float b) { a += b; }", "float x = 3.0; f(x, x = 10.0); r = vec4(x);", [20.; 4]),
        with(
            "float f(const in float a) { return a * 2.0; } float f(int a) { return float(a) + 0.5; }",
            "r = vec4(f(1.0), f(1), 0, 0);",
            [2., 1.5, 0., 0.],
        ),
        with(
            "vec2[2] f(vec2 a[2]) { a[0] += 1.0; return a; }",
            "vec2 a[2] = vec2[2](vec2(1), vec2(2)); r = vec4(f(a)[0], a[0]);",
            [2., 2., 1., 1.],
        ),
    ]);
}

#[test]
fn loops_and_jumps() {
    check(&[
        case(
            "int n = 0; for (int i = 0; i < 10; i++) { if (i == 3) continue; if (i == 6) break; n += i; } r = vec4(n);",
            [12.; 4],
        ),
        case(
            "int n = 0, i = 0; while (i < 5) { i++; if (i == 2) continue; n += i; } r = vec4(n, i, 0, 0);",
            [13., 5., 0., 0.],
        ),
        case(
            "int n = 0, i = 0; do { i++; if (i == 2) continue; n += i; } while (i < 5); r = vec4(n, i, 0, 0);",
            [13., 5., 0., 0.],
        ),
        case("int n = 0; do { n++; } while (false); r = vec4(n);", [1.; 4]),
        case("int n = 0; do { n++; if (n == 3) break; } while (true); r = vec4(n);", [3.; 4]),
        case("int n = 0; for (;;) { if (++n > 4) break; } r = vec4(n);", [5.; 4]),
        case("int n = 0; for (int i = 0, j = 9; i < j; i++, j--) n += j - i; r = vec4(n);", [25.; 4]),
        case(
            "int n = 0; for (int i = 0; i < 3; i++) for (int j = 0; j < 3; j++) { if (j == 2) break; if (i == 1) \
             continue; n += 10 * i + j; } r = vec4(n);",
            [42.; 4],
        ),
        case("int i = 3, n = 0; while (bool(i--)) n += i; r = vec4(n, i, 0, 0);", [3., -1., 0., 0.]),
        case("int i = 0; while (bool b = i < 3) { i++; if (!b) r.x = 5.0; } r = vec4(i);", [3.; 4]),
        with(
            "float f(int n) { for (int i = 0; i < 10; i++) { for (;;) { if (i == n) return float(i); break; } } return \
             -1.0; }",
            "r = vec4(f(4), f(99), f(I), 0);",
            [4., -1., 0., 0.],
        ),
        case(
            "int n = 0; for (int i = 0; i < 4; ++i) { switch (i) { case 1: continue; case 2: n += 100; break; default: \
             n += 1; } n += 10; } r = vec4(n);",
            [132.; 4],
        ),
        case(
            "for (int i = 0; i < 0; i++) r = vec4(9); for (float x = 0.0; x < 1.0; x += 0.25) r.x += 1.0; r.yzw = \
             vec3(0.0);",
            [-73., 0., 0., 0.],
        ),
        case("int n = 0; for (uint i = 5u; i > 0u; --i) n += int(i); r = vec4(n);", [15.; 4]),
        case(
            "int n = 0, k = 0; for (int i = 0; i < 20; k += i > 3 ? (n++, 2) : 1, i++) { if (k > 10) break; if (i % 2 \
             == 0) continue; n += 100; } r = vec4(n, k, 0, 0);",
            [404., 12., 0., 0.],
        ),
    ]);
}

#[test]
fn switches() {
    const F: &str = "int f(int i) { int n = 0; switch (i) { case 0: n += 1; case 1: n += 10; break; case 2: case 3: n \
                     += 100; default: n += 1000; case 7: n += 10000; } return n; }";
    check(&[
        with(F, "r = vec4(f(I), f(I + 1), f(I + 2), f(I + 3));", [11., 10., 11100., 11100.]),
        with(F, "r = vec4(f(I + 7), f(I + 8), f(I - 1), 0);", [10000., 11000., 11000., 0.]),
        with(
            "int f(uint i) { switch (i) { case 1u: return 5; case 4294967295u: return 6; } return 7; }",
            "r = vec4(f(U + 1u), f(U - 1u), f(U), 0);",
            [5., 6., 7., 0.],
        ),
        case("int n = 0; switch (I) { default: n = 1; break; case 3: n = 2; } r = vec4(n);", [1.; 4]),
        case("switch (I) { case 0: float x = 3.0; r = vec4(x); break; case 1: x = 4.0; r = vec4(x); }", [3.; 4]),
        case(
            "switch (I + 1) { case 0: float x = 3.0; case 1: x += 4.0; r = vec4(1.0, x > 0.0, 0, 0); }",
            [1., 1., 0., 0.],
        ),
        case(
            "switch (I) { case 0: switch (I + 1) { case 1: r = vec4(2); break; default: r = vec4(3); } break; case 1: \
             r = vec4(4); }",
            [2.; 4],
        ),
        case("r = vec4(1); switch (I + 9) { case 0: case 1: r = vec4(2); }", [1.; 4]),
        case(
            "int n = 0; for (int i = 0; i < 5; i++) switch (i) { case 1: n += 1; case 2: if (n > 1) break; n += 10; \
             case 3: n += 100; } r = vec4(n);",
            [211.; 4],
        ),
    ]);
}

#[test]
fn indices() {
    check(&[
        case(
            "float a[4] = float[4](1.0, 2.0, 3.0, 4.0); r = vec4(a[I - 1], a[I + 2], a[I + 4], a[I + 999]);",
            [1., 3., 4., 4.],
        ),
        case("vec4 v = vec4(1, 2, 3, 4); r = vec4(v[I - 1], v[I + 2], v[I + 4], v[I + 1]);", [1., 3., 4., 2.]),
        case("mat3 m = mat3(1, 2, 3, 4, 5, 6, 7, 8, 9); r = vec4(m[I + 1], m[I + 5][I - 3]);", [4., 5., 6., 7.]),
        case("mat2 m = mat2(0.0); m[I + 1][I] = 5.0; m[I][1] += 2.0; r = vec4(m[0], m[1]);", [0., 2., 5., 0.]),
        case("vec4 v = vec4(0); for (int i = 0; i < 4; i++) v[i] = float(i * i); r = v;", [0., 1., 4., 9.]),
        case(
            "float a[8]; for (int i = 0; i < 8; i++) a[i] = float(i); float s = 0.0; for (int i = 7; i >= 0; i -= 2) s \
             += a[i] * a[7 - i]; r = vec4(s, a[I + 3 & 7], a[(I + 13) % 8], a[min(I + 20, 7)]);",
            [28., 3., 5., 7.],
        ),
        with(
            "const int T[5] = int[](2, 3, 5, 7, 11);",
            "int s = 0; for (int i = 0; i < T.length(); i++) s += T[i]; r = vec4(s, T[I + 1], T[uint(I) - 1u], T[4]);",
            [28., 3., 11., 11.],
        ),
        with(
            "vec2 f(int i) { vec2 t[3] = vec2[3](vec2(1), vec2(2), vec2(3)); return t[i]; }",
            "r = vec4(f(I), f(I + 2));",
            [1., 1., 3., 3.],
        ),
        with(
            "struct S { float a; float b[2]; }; const S T[2] = S[2](S(1.0, float[2](2.0, 3.0)), S(4.0, float[2](5.0, \
             6.0)));",
            "r = vec4(T[I + 1].a, T[I + 1].b[I + 1], T[I].b[0], T[1].b[I]);",
            [4., 6., 2., 5.],
        ),
        case("vec4 v = vec4(1, 2, 3, 4); v.wzyx[I] = 9.0; v.zw[I - 1] += 0.5; r = v;", [1., 2., 3.5, 9.]),
        case("r = vec4(vec3(1, 2, 3).zyx[I], vec4(1, 2, 3, 4)[I + 3], mat2(1, 2, 3, 4)[I + 1]);", [3., 4., 3., 4.]),
        case("r = vec4(iChannelTime[I], iChannelResolution[I + 1].x, iChannelResolution[I].yz);", [0.; 4]),
        case(
            "float t[4] = iChannelTime; vec3 s[4] = iChannelResolution; r = vec4(t[I], s[I]) + float(t.length());",
            [4.; 4],
        ),
        with(
            "float f(float a[3], int i) { return a[i]; }",
            "r = vec4(f(float[3](1.0, 2.0, 3.0), I + 1), f(float[](4.0, 5.0, 6.0), I + 2), 0, 0);",
            [2., 6., 0., 0.],
        ),
    ]);
}

#[test]
fn integers() {
    check(&[
        case("r = vec4(-7 / 2 + I, (I + 13) % 8, (7 + I) / -2, (7 + I) % 4);", [-3., 5., -3., 3.]),
        case("r = vec4((I - 7) / 2, (7u + U) % 4u, (I - 7) >> 1, uint(I - 7) >> 28);", [-3., 3., -4., 15.]),
        // Undefined (section 5.9); on graphics cards Mesa computes the remainder with the divisor's sign (NIR's
        // `imod`).
        case("r = vec4((I - 7) % 2, (I - 7) % 3, (7 + I) % (I - 3), (I - 7) % (I - 3));", [1., 2., -2., -1.]),
        case("ivec4 a = ivec4(-7, 7, -6, 6) + I; r = vec4(a % ivec4(4, -4, 3, -3));", [1., -1., 0., 0.]),
        case(
            "r = vec4(float(2147483647 + I + 1 == -2147483647 - 1), float(U - 1u == 4294967295u), 0xffu + U, 1u << (U \
             + 3u));",
            [1., 1., 255., 8.],
        ),
        case("r = vec4((I + 6) & 3, (I + 6) | 9, (I + 6) ^ 5, ~(I + 6));", [2., 15., 3., -7.]),
        case("ivec2 a = ivec2(7, -7) + I; a /= 2; a <<= 1; a -= ivec2(1); r = vec4(a, a * 3);", [5., -7., 15., -21.]),
        case("uvec3 a = uvec3(1, 2, 3) + U; a = a * 5u % 4u; r = vec4(a, a.x << 1u);", [1., 2., 3., 2.]),
        case(
            "int d = I; int q = 5 / d; int m = 5 % d; uint u = 5u / U; r = vec4(1); if (q == 12345 && m == 54321 && u \
             == 77u) r = vec4(2);",
            [1.; 4],
        ),
        case("int low = -2147483647 - 1 + I; int q = low / (I - 1); r = vec4(1.0); if (q == 3) r = vec4(2);", [1.; 4]),
        case("r = vec4(1 << (I + 4), -16 >> (I + 2), 256u >> (I + 3), (I + 1) << 31 < 0);", [16., -4., 32., 1.]),
        case(
            "r = vec4(int(-1.7 + Z), int(2.9 + Z), uint(3.99 + Z), float(-2147483647 - 1 + I));",
            [-1., 2., 3., -2147483648.],
        ),
        case(
            "r = vec4(uint(-3.5 + Z) == 0u, uint(4294967040.0 + Z) == 4294967040u, uint(I - 1) == 4294967295u, \
             int(3000000000u + U) < 0);",
            [1., 1., 1., 1.],
        ),
        case("r = vec4(abs(I - 3), sign(float(I) - 3.0), sign(I - 3), min(I + 3, 2));", [3., -1., -1., 2.]),
        case("r = vec4(max(uvec2(3u, 5u) + U, 4u), clamp(ivec2(I - 5, I + 5), 0, 3));", [4., 5., 0., 3.]),
        case(
            "uint a = 5u; a = -a + U; bool b = a == 4294967291u; int i = 7; i %= 4; i ^= 1; i |= 8; i &= 14; i >>= 1; \
             r = vec4(b, i, 0, 0);",
            [1., 5., 0., 0.],
        ),
    ]);
}

#[test]
fn floats() {
    check(&[
        case("r = vec4(mod(Z - 1.5, 1.0), mod(5.5 + Z, -2.0), mod(vec2(7.0, -7.0) + Z, 3.0));", [0.5, -0.5, 1., 2.]),
        case(
            "r = vec4(atan(Z + 1.0, -1.0), atan(Z - 1.0), pow(Z + 2.0, 0.5), exp2(Z + 3.0));",
            [2.3561945, -std::f32::consts::FRAC_PI_4, std::f32::consts::SQRT_2, 8.],
        ),
        case(
            "float w; float f = modf(Z - 3.25, w); vec2 w2; vec2 f2 = modf(vec2(1.5, -1.5) + Z, w2); r = vec4(f, w, \
             f2.x + f2.y, w2.x * 10.0 + w2.y);",
            [-0.25, -3., 0., 9.],
        ),
        case("r = vec4(roundEven(2.5 + Z), roundEven(3.5 + Z), trunc(Z - 2.7), fract(Z - 0.25));", [2., 4., -2., 0.75]),
        case(
            "r = vec4(mix(1.0, 3.0, Z + 0.25), mix(vec2(0), vec2(10), 0.5 + Z), mix(2.0, 5.0, Z == 0.0));",
            [1.5, 5., 5., 5.],
        ),
        case(
            "r = vec4(mix(vec3(1, 2, 3), vec3(4, 5, 6), bvec3(true, Z > 0.0, Z == 0.0)), step(0.5, Z + 0.7));",
            [4., 2., 6., 1.],
        ),
        case(
            "r = vec4(smoothstep(0.0, 1.0, Z + 0.5), smoothstep(1.0, 0.0, Z + 0.25), smoothstep(vec2(0), vec2(2), \
             vec2(1.0 + Z)));",
            [0.5, 0.84375, 0.5, 0.5],
        ),
        case("r = vec4(step(vec2(1, 3), vec2(2.0 + Z)), smoothstep(0.0, 2.0, vec2(0.0, 1.0) + Z));", [1., 0., 0., 0.5]),
        // An interval of zero width: a step, also where only the driver can see that.
        case(
            "float e = Z + 0.5; r = vec4(smoothstep(e, e, Z + vec2(0.25, 0.75)), smoothstep(0.5, 0.5, Z + vec2(0.25, \
             0.75)));",
            [0., 1., 0., 1.],
        ),
        case(
            "r = vec4(length(Z - 3.0), distance(Z + 1.0, 4.0), dot(Z + 2.0, 3.0), normalize(Z - 5.0));",
            [3., 3., 6., -1.],
        ),
        case(
            "r = vec4(reflect(Z + 1.0, 1.0), refract(Z + 0.5, 1.0, 1.0), faceforward(Z + 2.0, 1.0, 1.0), faceforward(Z \
             + 2.0, 1.0, -1.0));",
            [-1., -0.5, -2., 2.],
        ),
        case("r = vec4(cross(vec3(1, 0, 0) + Z, vec3(0, 1, 0)), dot(vec3(1, 2, 3), vec3(Z + 1.0)));", [0., 0., 1., 6.]),
        case(
            "r = vec4(floatBitsToInt(Z + 1.0) == 0x3f800000, floatBitsToUint(Z - 1.0) == 0xbf800000u, \
             intBitsToFloat(0x40000000 + I), uintBitsToFloat(0x40400000u + U));",
            [1., 1., 2., 3.],
        ),
        case(
            "r = vec4(unpackHalf2x16(packHalf2x16(vec2(1.5, -2.0) + Z)), unpackUnorm2x16(packUnorm2x16(vec2(1.0, 0.0) \
             + Z)));",
            [1.5, -2., 1., 0.],
        ),
        case(
            "r = vec4(unpackSnorm2x16(packSnorm2x16(vec2(1.0, -1.0) + Z)), degrees(Z + 3.14159265), radians(Z + \
             180.0));",
            [1., -1., 180., std::f32::consts::PI],
        ),
        case(
            "r = vec4(sinh(Z + 1.0), cosh(Z + 1.0), tanh(Z + 1.0), asinh(Z + 1.0));",
            [1.1752012, 1.5430806, 0.7615942, 0.8813736],
        ),
        // The arc sines of drivers are accurate to two digits.
        case(
            "r = vec4(acosh(Z + 2.0), atanh(Z + 0.5), floor(1e2 * asin(Z + 0.5)), floor(1e2 * acos(Z + 0.5)));",
            [1.316958, 0.5493061, 52., 104.],
        ),
        case(
            "r = vec4(tan(Z + 1.0), log(Z + 2.0), log2(Z + 8.0), inversesqrt(Z + 4.0));",
            [1.5574077, std::f32::consts::LN_2, 3., 0.5],
        ),
        case(
            "r = vec4(any(lessThan(vec2(1, 2) + Z, vec2(1, 3))), all(greaterThanEqual(ivec2(1, 2) + I, ivec2(1, 3))), \
             not(bvec2(Z > 0.0, true)));",
            [1., 0., 1., 0.],
        ),
    ]);
}

#[test]
fn matrices() {
    check(&[
        case("mat2 m = mat2(1, 2, 3, 4) + Z; r = vec4(m * vec2(1, 1), vec2(1, 1) * m);", [4., 6., 3., 7.]),
        case(
            "mat2x3 m = mat2x3(1, 2, 3, 4, 5, 6); vec3 v = m * vec2(1.0 + Z, 1.0); r = vec4(v, (v * m).x);",
            [5., 7., 9., 46.],
        ),
        case("mat2 m = mat2(1, 2, 3, 4) * mat2(Z + 0.0, 1, 1, 0); r = vec4(m[0], m[1]);", [3., 4., 1., 2.]),
        case(
            "mat3x2 a = mat3x2(1, 2, 3, 4, 5, 6); mat2x3 b = transpose(a); mat2 c = a * b; r = vec4(c[0], c[1]);",
            [35., 44., 44., 56.],
        ),
        case(
            "mat2 m = mat2(2.0 + Z); m += 1.0; m -= mat2(1, 0, 0, 1); m *= 2.0; m /= 4.0; r = vec4(m[0], m[1]);",
            [1., 0.5, 0.5, 1.],
        ),
        case("mat2 m = 2.0 / (mat2(1, 2, 4, 8) + Z); r = vec4(m[0], m[1]);", [2., 1., 0.5, 0.25]),
        case(
            "mat2 a = mat2(1, 2, 3, 4) + Z; mat2 b = a / a - 1.0; mat2 c = -a; r = vec4(b[0] + b[1], c[1]);",
            [0., 0., -3., -4.],
        ),
        case("mat2 m = inverse(mat2(1, 2, 3, 4) + Z); r = vec4(m[0], m[1]);", [-2., 1., 1.5, -0.5]),
        case(
            "mat3 m = mat3(2, 1, 0, 0, 3, 1, 1, 0, 4) + Z; mat3 e = m * inverse(m); r = vec4(e[0], e[1].y);",
            [1., 0., 0., 1.],
        ),
        case(
            "mat3 m = mat3(2, 1, 0, 0, 3, 1, 1, 0, 4) + Z; mat3 e = m * inverse(m); r = vec4(e[1].xz, e[2].xz);",
            [0., 0., 0., 1.],
        ),
        case(
            "mat4 m = mat4(2, 1, 0, 5, 0, 3, 1, 1, 1, 0, 4, 2, 3, 3, 1, 7) + Z; mat4 e = inverse(m) * m; r = e[0] + \
             e[1] + e[2] + e[3];",
            [1.; 4],
        ),
        case(
            "mat4 m = mat4(2, 1, 0, 5, 0, 3, 1, 1, 1, 0, 4, 2, 3, 3, 1, 7) + Z; mat4 e = inverse(m) * m; r = e[2];",
            [0., 0., 1., 0.],
        ),
        case(
            "r = vec4(determinant(mat2(1, 2, 3, 4) + Z), determinant(mat3(2, 1, 0, 0, 3, 1, 1, 0, 4) + Z), \
             determinant(mat4(2.0 + Z)), 0);",
            [-2., 25., 16., 0.],
        ),
        case("mat3x2 m = outerProduct(vec2(1, 2) + Z, vec3(3, 4, 5)); r = vec4(m[0], m[2]);", [3., 6., 5., 10.]),
        case("mat2 m = matrixCompMult(mat2(1, 2, 3, 4) + Z, mat2(2)); r = vec4(m[0], m[1]);", [2., 0., 0., 8.]),
        case(
            "mat4 a = mat4(mat2(1, 2, 3, 4) + Z); mat2 b = mat2(a); mat3 c = mat3(mat4x2(1, 2, 3, 4, 5, 6, 7, 8)); r = \
             vec4(a[1].xyz + a[3].www, c[2].z + b[1].y);",
            [4., 5., 1., 5.],
        ),
        case("mat3 m = mat3(vec4(1, 2, 3, 4) + Z, vec4(5, 6, 7, 8), 9.0); r = vec4(m[0].z, m[1]);", [3., 4., 5., 6.]),
        case("mat2 m = mat2(1, 2, 3, 4) + Z; m++; --m[1].y; mat2 o = m--; r = vec4(o[0], m[1]);", [2., 3., 3., 3.]),
        case(
            "mat2 m = mat2(1, 2, 3, 4) + Z; mat2 n = m; n[1][1] += Z; bool e = m == n; n[0][1] = 9.0; r = vec4(e, m == \
             n, m != n, 0);",
            [1., 0., 1., 0.],
        ),
    ]);
}

#[test]
fn aggregates() {
    const S: &str = "struct P { vec2 a; bool b; }; struct S { P p[2]; mat2 m; uint u; };";
    check(&[
        with(
            S,
            "S s = S(P[2](P(vec2(1), true), P(vec2(2), false)), mat2(3), 4u); S t = s; t.p[I + 1].a.y += Z; bool e = s \
             == t; t.p[1].b = true; r = vec4(e, s == t, s != t, t.m[1].y);",
            [1., 0., 1., 3.],
        ),
        case(
            "float a[3] = float[3](1.0, 2.0, 3.0), b[3] = a; bool e = a == b; b[I + 2] = 0.0; r = vec4(e, a == b, a != \
             b, b[2]);",
            [1., 0., 1., 0.],
        ),
        case("bvec3 b = bvec3(I == 0, I > 0, true); r = vec4(b, b == bvec3(true, false, true));", [1., 0., 1., 1.]),
        case("r = vec4(vec2(ivec3(I + 1, 2, 3)), bvec2(vec2(Z, 2.0)));", [1., 2., 0., 1.]),
        case(
            "vec4 v = vec4(vec2(1), mat2(2)); ivec3 i = ivec3(vec4(1.5, 2.5, 3.5, 4.5) + Z); r = vec4(v.zw, i.yz);",
            [2., 0., 2., 3.],
        ),
        case("vec4 m = vec4(mat2(1, 2, 3, 4)); uvec2 u = uvec2(true, I == 1); r = vec4(m.wx, u);", [4., 1., 1., 0.]),
        with(
            "struct N { float x; }; N make(float x) { return N(x * 2.0); }",
            "r = vec4(make(3.0).x, N(Z + 4.0).x, float[2](5.0, 6.0 + Z)[1], vec3(7.0 + Z).y);",
            [6., 4., 6., 7.],
        ),
        case("bool a = I == 0, b = true; r = vec4(a ^^ b, a ^^ !b, a && b, a || b);", [0., 1., 1., 1.]),
    ]);
}

/// Small tables are in memory, arrays of more than 32 elements in the uniform buffer, and tables of 256 scalars or
/// more in the storage buffer.
#[test]
fn constant_tables_can_be_read_from_every_kind_of_memory() {
    check_tables(8, 40);
    check_tables(40, 300);
}

fn check_tables(records: usize, others: usize) {
    let list = |count: usize, element: &dyn Fn(usize) -> String| (0..count).map(element).collect::<Vec<_>>().join(", ");
    let structs = list(records, &|i| {
        format!("S(vec3({i}, {i}.25, {i}.5), {i}0.0, mat2x3({}))", list(6, &|k| format!("{}.0", i + k + 1)))
    });
    let threes = list(others, &|i| format!("vec3({i}, {}, {})", i * 2, i * 3));
    let flags = list(others, &|i| (i % 3 == 0).to_string());
    let numbers = list(others, &|i| format!("{i}u"));
    // Leaking a few texts is fine: a case needs a text that lives as long as the program.
    let before: &'static str = Box::leak(
        format!(
            "struct S {{ vec3 v; float f; mat2x3 m; }};\nconst S RECORDS[{records}] = S[]({structs});\n\
             const vec3 THREES[{others}] = vec3[]({threes});\nconst bool FLAGS[{others}] = bool[]({flags});\n\
             const uint NUMBERS[{others}] = uint[]({numbers});\nuint unwritten[{others}] = uint[]({numbers});"
        )
        .into_boxed_str(),
    );
    let last = (others - 1) as f32;
    check(&[
        with(
            before,
            "r = vec4(RECORDS[I + 5].v.y, RECORDS[I + 5].f, RECORDS[I + 5].m[I + 1].z, RECORDS[I + 7].m[0][I + 1]);",
            [5.25, 50., 11., 9.],
        ),
        with(before, "S s = RECORDS[I + 2]; r = vec4(s.v.z, s.m[1].x, THREES[I + 39].yz);", [2.5, 6., 78., 117.]),
        with(before, "r = vec4(FLAGS[I + 9], FLAGS[I + 10], NUMBERS[I + 31], unwritten[I + 17]);", [1., 0., 31., 17.]),
        // An index beyond either end is clamped, as WebGL guarantees.
        with(
            before,
            "r = vec4(NUMBERS[I + 999], NUMBERS[I - 9], THREES[I - 1].x, THREES[I + 300].x);",
            [last, 0., 0., last],
        ),
    ]);
}
