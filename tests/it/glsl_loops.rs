//! The values that loops compute: loops with a known number of iterations, which drivers unroll, and loops that read
//! values that they write.

use crate::support::{compute::*, walked::assert_walked, *};
use eddy::{
    engine::Engine,
    gpu::Gpu,
    project::{PassName, Project},
};

#[test]
fn loops_with_a_known_number_of_iterations() {
    check(&[
        // A variable that is declared in a body starts fresh in each iteration; one that depends on the counter
        // follows it.
        case(
            "r = vec4(0); for (int i = 0; i < 4; i++) { float f; f += float(i); r.x += f; int d = i * 2; r.y += \
             float(d); }",
            [6., 12., 0., 0.],
        ),
        case(
            "float a[4]; r = vec4(0); for (int i = 0; i < 4; i++) { a[i] += float(i + I); int j = 3 - i; r.x += a[j]; \
             }",
            [1., 0., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 3; i++) { float b[2]; b[I] += 1.0; b[I + 1] = b[I] + float(i); r.x += \
             b[I + 1]; }",
            [6., 0., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 3; i++) { const float t[3] = float[](5., 6., 7.); float u[3] = t; r.x += \
             u[i]; r.y = u[I + i]; }",
            [18., 7., 0., 0.],
        ),
        // The counter keeps its value after the loop, and inside the loop it has the current value at each use.
        case(
            "int i; for (i = 0; i < 5; i += 2) {} r = vec4(i, 0, 0, 0); for (float f = 0.5; f < 3.0; f++) r.y += f;",
            [6., 4.5, 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0, j = 3; i < 4; i++, j--) { r.x = r.x * 10.0 + float(i); r.y = r.y * 10.0 + \
             float(j); }",
            [123., 3210., 0., 0.],
        ),
        case(
            "r = vec4(0); for (uint u = 4294967294u; u != 2u; u++) r.x += 1.0; for (int i = 1; i > 0; i *= 65536) r.y \
             += 1.0;",
            [4., 2., 0., 0.],
        ),
        // Jumps.
        with(
            "float f(int n) { for (int i = 0; i < 6; i++) { if (i == n) return float(i); } return -1.0; }",
            "r = vec4(f(I), f(I + 4), f(I + 6), 0);",
            [0., 4., -1., 0.],
        ),
        with(
            "float f() { for (int i = 3; i < 6; i++) { return float(i); } return -1.0; }",
            "r = vec4(f(), 1, 0, 0);",
            [3., 1., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 4; i++) { switch (i + I) { case 1: r.x += 1.0; break; case 2: r.x += \
             10.0; default: r.x += 100.0; } }",
            [311., 0., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 3; i++) { for (int j = 0; j < 9; j++) { if (j > i + I) break; r.x += \
             1.0; } }",
            [6., 0., 0., 0.],
        ),
        // The outer counter as the bound of an inner loop and of an index.
        case(
            "float a[3] = float[](1.0, 2.0, 4.0); r = vec4(0); for (int i = 0; i < 3; i++) for (int j = 0; j <= i; \
             j++) r.x += a[j + I];",
            [11., 0., 0., 0.],
        ),
    ]);
}

/// A value that an iteration writes, directly or by a call, is read again in the next one; a value that no iteration
/// writes may be read once.
#[test]
fn loops_read_what_they_write() {
    const STATE: &str = "float G = 1.0; vec2 H; struct S { float a, b; }; S s;\n\
        void step_up() { G += 1.0; } void add(inout float x, float y) { x += y; }\n\
        float far(float x) { while (x > 99.0) return G; H.y += x; return H.y; }";
    check(&[
        with(
            STATE,
            "r = vec4(G); for (int i = 0; i < I + 3; i++) { r.x += G; step_up(); r.y += G; } r.zw = vec2(G, 0);",
            [7., 10., 4., 0.],
        ),
        with(
            STATE,
            "float x = 1.0; r = vec4(x); for (int i = 0; i < I + 3; i++) { r.x = x; add(x, x); } r.yzw = vec3(x, 0, \
             0);",
            [4., 8., 0., 0.],
        ),
        with(
            STATE,
            "H = vec2(1.0, 2.0); r = H.xyxy; int i = 0; do { r.x = H.x + H.y; r.y = far(r.x); } while (++i < I + 2);",
            [6., 11., 1., 2.],
        ),
        with(
            STATE,
            "s.a = 1.0; s.b = 2.0; r = vec4(s.a, s.b, 0, 0); int i = 0;\n\
             while (i < I + 3) { r.z += s.a; if (i == 1) s.a = 5.0; r.w += s.b; i++; }",
            [1., 2., 7., 6.],
        ),
        with(
            STATE,
            "s.a = 1.0; r = vec4(0); for (int i = 0; i < I + 2; i++) { for (int j = 0; j < 2; j++) { r.x += s.a; \
             add(s.a, 1.0); } r.y += s.a; }",
            [10., 8., 0., 0.],
        ),
        // A `discard` keeps a function from being inlined.
        with(
            "float G = 1.0; float apart(float x) { if (x > 9.0) discard; G += x; return x; }",
            "r = vec4(G); for (int i = 0; i < I + 3; i++) { r.x += G; r.y += apart(2.0); } r.z = G;",
            [10., 7., 7., 1.],
        ),
        case(
            "float w = 1.0; r = vec4(w, 0, 0, 0); for (int i = 0; i < I + 2; i++) { r.y += w; r.z += modf(2.5 + \
             float(i), w); } r.w = w;",
            [1., 3., 1., 3.],
        ),
        case(
            "float a = 1.0, b = a; for (int i = 0; i < I + 3; b = a, i++) { if (i == 1) continue; a *= 2.0; } r = \
             vec4(a, b, 0, 0);",
            [4., 4., 0., 0.],
        ),
        case(
            "vec3 v = vec3(1, 2, 3); r.x = v.y; for (int i = 0; i < 3; i++) { r.x += v[(i + I) % 3]; v[(i + I + 1) % \
             3] = 0.0; } r.yzw = v;",
            [3., 0., 0., 0.],
        ),
    ]);
}

/// A condition or a step runs in every iteration: locals of the functions that it calls start fresh each time.
#[test]
fn conditions_and_steps_start_with_fresh_locals() {
    const SUM: &str = "int G; int sum(int i) { int b[4]; b[i & 3] += 1 + i; int s = 0; for (int k = 0; k < 4; k++) s \
                       += b[k]; G += s; return s; }";
    check(&[
        with(SUM, "r = vec4(0); for (int i = I; sum(i) < 4; i++) r.x++; r.y = float(G);", [3., 10., 0., 0.]),
        with(
            SUM,
            "r = vec4(0); for (int i = I; i < 3; sum(i), i++) { r.x++; if (i == 1) continue; } r.y = float(G);",
            [3., 6., 0., 0.],
        ),
        with(
            SUM,
            "r = vec4(0); int i = I; do { r.x++; if (i == 5) continue; } while (sum(i++) < 3); r.y = float(G);",
            [3., 6., 0., 0.],
        ),
        with(
            SUM,
            "r = vec4(0); int i = I; while (sum(i) < 4 && i < 9) { i++; r.x++; } r.y = float(G);",
            [3., 10., 0., 0.],
        ),
    ]);
}

/// Returns what eight pixels in a row draw, and checks that the walker computes the same: each is the `o` that `body`
/// sets for its number `x`; `before` is code at file scope.
fn row(before: &str, body: &str) -> Option<Vec<[f32; 4]>> {
    let (mut engine, project) = row_on(&gpu()?, before, body);
    assert_walked(&mut engine, &project, &PassName::image());
    Some(texels(&mut engine))
}

/// Draws such a row on a device.
fn row_on(gpu: &Gpu, before: &str, body: &str) -> (Engine, Project) {
    let code = format!("{before}\nvoid mainImage(out vec4 o, in vec2 p) {{ int x = int(p.x); {body} }}");
    let project = project(vec![image(&code, Default::default())]);
    (ran(gpu, &project, (8, 1), 1), project)
}

fn texels(engine: &mut Engine) -> Vec<[f32; 4]> {
    let pixels = engine.read(&PassName::image()).unwrap();
    (0..8).map(|x| texel(&pixels, x, 0)).collect()
}

/// A pixel keeps the values with which it left a loop while other pixels continue.
#[test]
fn pixels_leave_a_loop_one_by_one() {
    // `old` is computed at the start of an iteration, and each exit has the same value of it.
    let old = |x: f32| {
        let (mut a, mut b) = (x * 0.25, x * 0.5);
        loop {
            let old = a * 2.0 + b * x;
            a += (a.floor() + 1.0).min(2.0);
            b += a * 0.5;
            if a > x {
                return [old, a, b, 1.0];
            }
        }
    };
    let expected: Vec<_> = (0..8).map(|x| old(x as f32)).collect();
    let start = "float a = float(x) * .25, b = float(x) * .5, old = 0.;";
    let iteration = "old = a * 2. + b * float(x); for (int i = 0; i < 1 + min(iFrame, 0); i++) a += min(floor(a) + 1., \
                 2.); b += a * .5;";
    for form in [
        "while (true) { ROUND if (a > float(x)) break; }",
        "for (;;) { ROUND if (a > float(x) || b > 1e6) break; }",
        "do { ROUND } while (a <= float(x));",
        "while (old = -1., true) { ROUND if (a > float(x)) break; }",
    ] {
        let body = format!("{start} {} o = vec4(old, a, b, 1);", form.replace("ROUND", iteration));
        let Some(drawn) = row("", &body) else { return };
        assert_eq!(drawn, expected, "{form}");
    }
    let Some(drawn) = row("", COUNTED) else { return };
    assert_eq!(drawn, counted());
}

/// The first two pixels leave the loop in the first iteration.
const COUNTED: &str = "ivec3 v = ivec3(0, 0, 2); int fuel = 40;\n\
    while (true) { int c = v[x]; v[x] = c + 1; if (c < 2) break; if (--fuel < 0) break; } o = vec4(v, 1);";

fn counted() -> Vec<[f32; 4]> {
    [&[[1., 0., 2., 1.], [0., 1., 2., 1.]][..], &[[0., 0., 43., 1.]; 6]].concat()
}

/// A limit that is the minimum of two values is not a lower bound of the counter of a loop that counts down to it.
#[test]
fn loops_can_count_down_to_a_minimum() {
    const RETURNS: &str = "int until(int least) { int n = 0; for (int i = 4; i > 0; i--) { if (i <= least) return n; n \
                           += i; } return n; }";
    let sum = |x: i32| (x.min(6) + 1..5).sum::<i32>() as f32;
    let expected: Vec<_> = (0..8).map(|x| [sum(x), 0.0, 0.0, 1.0]).collect();
    for form in [
        "for (int i = 4; i > min(6, x); i--) n += i;",
        "int least = min(x, 6); for (int i = 4; i >= least + 1; i -= 1) n += i;",
        "int least = min(x, 6); for (int i = 4; !(least >= i); i -= 1) n += i;",
        "for (int i = 4;; i--) { if (i <= min(6, x)) break; n += i; }",
        "for (int i = 4;; i--) { if (min(6, x) < i && n < 100) { n += i; } else { break; } }",
        "int i = 5; while (--i > min(6, x)) n += i;",
        "for (int i = 4; n < 100 && i > min(6, x); i--) n += i;",
        "for (int i = 4; i > 99 || !(i <= min(6, x)); i--) n += i;",
        "for (int i = 4;; i--) { bool is_over = i <= min(6, x); if (is_over) break; n += i; }",
        "int i = 4; if (i > min(6, x)) do { n += i; i--; } while (i > min(6, x));",
        "n = until(min(6, x));",
        "for (float f = 4.; f > min(6., float(x)); f--) n += int(f);",
    ] {
        let Some(drawn) = row(RETURNS, &format!("int n = 0; {form} o = vec4(n, 0, 0, 1);")) else { return };
        assert_eq!(drawn, expected, "{form}");
    }
}

/// A fault is seen without its work-around if, and only if, the work-around is on for this version of the driver.
#[test]
fn work_arounds_are_on_where_their_faults_are_seen() {
    let Some(gpu) = gpu() else { return };
    let mut without = gpu.clone();
    (without.keeps_loops_open, without.misjudges_limits) = (false, false);
    let drawn = |body: &str| texels(&mut row_on(&without, "", body).0);
    assert_eq!(drawn(COUNTED) != counted(), gpu.keeps_loops_open, "{}", gpu.describe());
    let sums: Vec<_> = (0..8).map(|x: i32| [(x.min(6) + 1..5).sum::<i32>() as f32, 0.0, 0.0, 1.0]).collect();
    let down = drawn("int n = 0; for (int i = 4; i > min(6, x); i--) n += i; o = vec4(n, 0, 0, 1);");
    assert_eq!(down != sums, gpu.misjudges_limits, "{}", gpu.describe());
}
