//! Indices out of range access the nearest element and no other memory, also where code is inlined, unrolled or
//! duplicated: bounds that are known for a counter in one copy must not be used in another.
//!
//! The array `a` is between `g` and `h`, which must not change.

use crate::support::compute::*;

/// `digits` returns an array of four numbers below ten as a decimal number, whose last digit is the first element. The
/// other functions are for use in cases.
const FUNCTIONS: &str = "\
float digits(int v[4]) { int s = 0; for (int k = 3; k >= 0; k--) s = s * 10 + v[(k + I) & 3]; return float(s); }
int put(inout int v[4], int at) { v[at] = 7; return at; }
int add(inout int x, int by) { x += by; return x; }
int past(int v[4], int at) { if (at > 50) return v[at] + 1; for (int i = 0; i < 4; i += 100, at = i) if (I == 0) \
continue; return v[at]; }
struct S { int i; };
";

/// The contents of `a` after the statements `body`, as digits.
const fn bounds(body: &'static str, digits: f32) -> Case {
    Case { before: FUNCTIONS, body, expected: [digits, 0.0, 0.0, 1.0] }
}

/// Draws each case with `a` between the guards `g` and `h`.
fn check_guarded(cases: &[Case]) {
    let guarded = |case: &Case| {
        let body = format!(
            "int g[4], a[4], h[4]; g[I] = 0; h[I] = 0; {{ {} }} r = vec4(digits(a), digits(g), digits(h), 1);",
            case.body
        );
        // Leaking is fine here: the memory is small and the test process ends soon.
        Case { before: case.before, body: body.leak(), expected: case.expected }
    };
    check(&cases.iter().map(guarded).collect::<Vec<_>>());
}

#[test]
fn bounds_in_loop_steps_after_a_continue() {
    check_guarded(&[
        bounds("for (int i = 0; i < 4; i += 100, a[i] = 7) { if (I == 0) continue; a[i] = 1; }", 7000.),
        bounds("for (int i = 0; i < 4; i += 100, a[i] = 7) { if (I == 1) continue; a[i] = 1; }", 7001.),
        bounds("for (int i = 0; i < 4; a[i] = 7, i += 100) { if (I == 0) continue; a[i] = 1; }", 7.),
        bounds("for (int i = 3; i >= 0; i -= 100, a[i] = 7) { if (I == 0) continue; }", 7.),
        bounds("for (int i = 0; 4 > i; i += 100, a[i + 1] = 7, a[i - 1] = 6) { if (I == 0) continue; }", 6000.),
        bounds("for (uint i = 0u; i < 4u; i += 100u, a[i] = 7) { if (I == 0) continue; }", 7000.),
        bounds("for (float x = 0.0; x < 4.0; x += 100.0, a[int(x)] = 7) { if (I == 0) continue; }", 7000.),
        bounds("for (float x = 3.5; x >= 0.0; x -= 100.0, a[int(x)] = 7) { if (I == 0) continue; }", 7.),
        // Steps that wrap around.
        bounds("for (int i = 0; i < 4; i += 2147483647, a[i] = 7) { if (I == 0) continue; }", 7000.),
        bounds("for (int i = 1; i < 4; i += 2147483647, a[i] = 7) { if (I == 0) continue; }", 7007.),
        bounds("for (uint i = 3u; i < 4u; i--, a[i] = 7) { if (I == 0) continue; }", 7777.),
        bounds("for (uint i = 3u; i < 4u; i += 4294967295u, a[i] = 7) { if (I == 0) continue; a[i] = 1; }", 7777.),
        // Inside branches and switches.
        bounds(
            "for (int i = 0; i < 4; i += 100, a[i] = 7) { switch (i + I) { case 0: continue; default: a[i] = 1; } }",
            7000.,
        ),
        bounds(
            "for (int i = 0; i < 4; i += 100, a[i] = 7) { switch (i + I) { case 0: a[i] = 1; case 1: if (I == 0) \
             continue; } a[i] = 2; }",
            7001.,
        ),
        bounds(
            "for (int i = 0; i < 4; i += 100, a[i] = 7) { if (I == 0) { if (i < 9) continue; } else a[i] = 3; a[i] = \
             1; }",
            7000.,
        ),
        // Writes by a function, by an assignment inside an expression, and on one side of a choice.
        bounds("for (int i = 0; i < 4; i += 100, put(a, i)) { if (I == 0) continue; }", 7000.),
        bounds("int k; for (int i = 0; i < 4; i += 100, k = (a[i] = 7)) { if (I == 0) continue; }", 7000.),
        bounds("for (int i = 0; i < 4; i += 100, I == 0 ? a[i] = 7 : 0) { if (I == 0) continue; }", 7000.),
        bounds("for (int i = 0; i < 4; a[i += 100] = 7) { if (I == 0) continue; }", 7000.),
        bounds(
            "for (int i = 0; i < 4; i += 100) { a[1] = past(a, i); if (I == 0) continue; a[i] = 5; } a[3] += past(a, \
             99);",
            1000.,
        ),
    ]);
}

#[test]
fn bounds_in_nested_loops() {
    check_guarded(&[
        bounds(
            "for (int i = 0; i < 2; i++) for (int j = 0; j < 2; j += 50, a[i + j] = 7) { if (I == 0) continue; }",
            7000.,
        ),
        bounds(
            "for (int i = 0; i < 4; i += 100, a[i] = 7) { for (int j = 0; j < 4; j += 100, a[i] = 1) { if (I == 0) \
             continue; } if (I == 0) continue; }",
            7001.,
        ),
        bounds("for (int i = 0; i < 4; i++) { { int i = 100 + I; a[i] = 7; } }", 7000.),
        bounds(
            "for (int i = 0; i < 4; i += 100) { for (int i = 0; i < 3; i++) { a[i] = 1; if (I == 0) continue; } a[i] \
             += 2; }",
            113.,
        ),
        bounds("int i; for (i = 0; i < 4; i += 100) { for (i = 0; i < 2; i += 60) {} a[i] = 7; }", 7000.),
        bounds(
            "for (int i = 0; i < 4; i++) { int n = 0; while (n <= i) { n += 40; a[n] = 7; if (I == 0) continue; } }",
            7000.,
        ),
        bounds("for (int i = 0, j = 0; i < 4; i++, j += 30, a[j] = 7) { if (I == 0) continue; }", 7000.),
    ]);
}

/// An unknown limit bounds the counter on one side only, and only if the step cannot wrap.
#[test]
fn bounds_from_unknown_limits() {
    check_guarded(&[
        bounds("int n = I + 9; for (int i = 2; i < n; i++) a[i] = 7;", 7700.),
        bounds(
            "int n = I + 2147483647; for (int i = 2147483640; i <= n; i += 3) { a[i & 1] = 5; a[i] = 7; if (I == 0) break; }",
            7005.,
        ),
        bounds(
            "int n = I + 2147483647; for (int i = 2147483640; i < n; i += 5) { a[i] = i < 0 ? 4 : 7; if (i < 0) break; }",
            7004.,
        ),
        bounds("int n = I - 9; for (int i = 1; i > n; i--) a[i] = 7;", 77.),
        bounds("uint n = uint(I + 3); for (uint i = 1u; i < n; i++) a[i] = 7;", 770.),
        bounds("uint n = uint(I); int k = 0; for (uint i = 3u; i >= n; i--) { a[i] = 7; if (++k > 5) break; }", 7777.),
    ]);
}

#[test]
fn bounds_in_while_and_do_loops() {
    check_guarded(&[
        bounds("int i = 0; do { if (I == 0) continue; a[i] = 1; } while (i += 100, a[i] = 7, i < 4);", 7000.),
        bounds("int i = 0; do { i += 100; if (I == 0) continue; } while ((a[i] = 7) < 4);", 7000.),
        bounds("int n = 0; while (n < 4) { n += 100; a[n] = 7; if (I == 0) continue; }", 7000.),
        bounds("int n = 4; while (n >= 1) { n -= 100; a[n] = 7; }", 7.),
        bounds("int n = 4; while (n >= 1) { n--; a[n] = 7; }", 7777.),
        bounds("int n = 0; while (n < 4 && (a[n] = 7) > I) { if (I == 0) n += 100; }", 7.),
        // The condition is evaluated once more than the body.
        bounds("for (int i = 0; (a[i] += 7) > 0 && i < 4; i += 100) { if (I == 0) continue; }", 7007.),
        bounds("for (float x = 0.0; (a[int(x)] += 7) > 0 && x < 4.0; x += 100.0) { if (I == 0) continue; }", 7007.),
        // After the loop a counter has the value from the step.
        bounds("int i = 0; for (; i < 4; i += 100) { if (I == 0) continue; } a[i] = 7;", 7000.),
        bounds("int i = 3; while (i > 0) i -= 100; a[i] = 7;", 7.),
        // A remainder has the divisor's sign.
        bounds("a[(I - 7) % 4] = 7; a[(I - 7) % 3] = 6; a[(I - 6) % 3] = 5;", 675.),
        bounds("int d = (I & 1) + 3; a[(I - 7) % d] = 7; a[(-2147483647 - 1 + I) % d] = 6;", 760.),
        bounds("int d = (I & 1) - 3; a[(I + 7) % d] = 7; a[(I + 7) % -4 + 3] = 6;", 607.),
    ]);
}

#[test]
fn bounds_of_counters_that_other_code_writes() {
    check_guarded(&[
        bounds("for (int i = 0; i < 4;) { add(i, 100); a[i] = 7; }", 7000.),
        bounds("for (int i = 0; i < 4; add(i, 100)) { if (i == 0) add(i, 30); a[i] = 7; }", 7000.),
        bounds("for (int i = 0; i < 4; add(i, 100), a[i] = 7) { if (I == 0) continue; }", 7000.),
        bounds("for (int i = 0; i < 4; i++) { i += 100; a[i] = 7; }", 7000.),
        bounds("for (S s = S(0); s.i < 4; s.i += 100, a[s.i] = 7) { if (I == 0) continue; }", 7000.),
        bounds("for (ivec2 v = ivec2(0); v.x < 4; v.x += 100, a[v.x] = 7) { if (I == 0) continue; }", 7000.),
        bounds("switch (I) { case 0: int k = 2; k += 100; default: a[k] = 7; }", 7000.),
        bounds("switch (I + 1) { case 0: int k = 2; default: k = 100; a[k] = 7; }", 7000.),
        bounds(
            "for (int i = 0; i < 4; i += 100) { switch (i + I) { case 0: int k = i + 50; a[k] = 7; case 1: a[k - 50] = \
             1; continue; } }",
            7001.,
        ),
    ]);
}

/// Bounds known in one call of a function must not be used in the next call, nor after a return.
#[test]
fn bounds_in_inlined_functions() {
    const FUNCTIONS: &str = "\
float digits(int v[4]) { int s = 0; for (int k = 3; k >= 0; k--) s = s * 10 + v[(k + I) & 3]; return float(s); }
int G[4];
int walk(int from, int by) { int n = from; for (int i = from; i < 4; i += by) { if (i > 90) return i; G[i] = 7; n = i; \
if (I == 1) return 2; } G[n + by] = 6; return n + by; }
int twice(int at) { int n = at; if (at > 3) { G[n] = 5; return n; } for (int i = 0; i < 4; i += 100, G[i] = 8) { if (i \
== at) continue; return i; } G[n] = 4; return -n; }
";
    let inlined = |body, digits| Case { before: FUNCTIONS, body, expected: [digits, 0.0, 0.0, 1.0] };
    check(&[
        inlined("int q = walk(0, 100); r = vec4(digits(G), 0, 0, 1);", 6007.),
        inlined("int q = walk(3, 1); q = walk(I + 90, 1); r = vec4(digits(G), 0, 0, 1);", 6000.),
        inlined("int q = walk(walk(3, 100), 1); r = vec4(digits(G), 0, 0, 1);", 6000.),
        inlined("twice(0); twice(100); r = vec4(digits(G), 0, 0, 1);", 5004.),
        inlined(
            "for (int i = 0; i < 4; i += 100, twice(i)) { if (I == 0) continue; } r = vec4(digits(G), 0, 0, 1);",
            5000.,
        ),
        inlined(
            "for (int i = 0; walk(i, 100) < 0 || i < 4; i += 100) { if (I == 0) continue; } r = vec4(digits(G), 0, 0, \
             1);",
            6007.,
        ),
    ]);
}

/// The product of two uints can exceed the range of an i64.
#[test]
fn bounds_of_large_products() {
    check_guarded(&[
        // Bounds of an argument in one call must not be used for the next call, nor those of a counter after its loop.
        bounds("for (int i = 0; i < 3; i++) put(a, i); put(a, I + 9);", 7777.),
        bounds("int i; for (i = 1; i < 3; i++) put(a, i); put(a, i * 9);", 7770.),
        bounds("int w = I - int(iResolution.x); put(a, w); put(a, 9 * int(iResolution.y));", 7007.),
        bounds("uint u = uint(I) + 3u; a[int(((u & 0xffffffffu) * (u & 0xffffffffu)) % 16u)] = 7;", 7000.),
        bounds("uint u = uint(I) + 3u; a[int(50u / ((u & 0xffffffffu) * (u & 0xffffffffu)))] = 7;", 7000.),
        bounds("int i = I - 3; a[(i * 0x7fffffff) * (i * 0x7fffffff)] = 7;", 7000.),
    ]);
}

/// Indices of vectors, matrices, constant tables and structures are clamped as those of arrays are.
#[test]
fn bounds_of_vectors_matrices_and_tables() {
    check(&[
        case(
            "ivec4 v = ivec4(0); for (int i = 0; i < 4; i += 100, v[i] = 7) { if (I == 0) continue; } r = vec4(v);",
            [0., 0., 0., 7.],
        ),
        case(
            "mat4 m = mat4(0); for (int i = 0; i < 4; i += 100, m[i][i - 200] = 7.0) { if (I == 0) continue; } r = \
             m[3];",
            [7., 0., 0., 0.],
        ),
        case(
            "vec4 v = vec4(0); for (int i = 0; i < 4; i += 100, v.wzy[i] = 7.0) { if (I == 0) continue; } r = v;",
            [0., 7., 0., 0.],
        ),
        case(
            "const float t[4] = float[](1., 2., 3., 4.); r = vec4(0); for (int i = 0; i < 4; i += 100, r.x += t[i]) { \
             r.y += t[i]; if (I == 0) continue; }",
            [4., 1., 0., 0.],
        ),
        with(
            "struct T { int a[3]; int b; }; T t[2];",
            "for (int i = 0; i < 2; i += 100, t[i].a[i] = 7) { t[i].b = 1; if (I == 0) continue; } r = vec4(t[0].b, \
             t[1].b, t[1].a[2], t[1].a[0]);",
            [1., 0., 7., 0.],
        ),
    ]);
}
