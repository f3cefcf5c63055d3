//! Behaviour that the specification leaves open but pictures depend on: as in OpenGL drivers and browsers, on any
//! driver.
//!
//! `Z` is a zero that a compiler cannot see through, so that constant folding does not apply.

use crate::support::{compute::*, ir, *};
use eddy::glsl::{self, Driver, PassSource};

/// A driver may replace a quotient by any value if it can see that the divisor is zero.
#[test]
fn divisions_by_a_constant_zero_are_infinite() {
    check(&[
        with(
            "float unite(float a, float b, float k) {\n\
             float h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0); return mix(b, a, h) - k * h * (1.0 - h); }",
            "r = vec4(unite(Z + 1.0, Z + 2.0, 0.0), unite(Z + 4.0, Z + 3.0, 0.0), 0, 0);",
            [1., 3., 0., 0.],
        ),
        with(
            "struct S { vec2 blur; float width; }; S s;\n\
             void set(float b) { s.blur = b == 0.0 ? vec2(0.0, 1.0) : vec2(b, 0.0); }\n\
             float edge(float w) { return clamp(-w / s.blur.x + s.blur.y, 0.0, 1.0); }",
            "set(0.0); r = vec4(edge(Z + 1.0), edge(Z - 1.0), 0, 0);",
            [0., 1., 0., 0.],
        ),
        with(
            "float over(float k) { return (Z + 3.0) / k; } float zero() { return 0.0; }",
            "float unset, a = Z - 2.0; a /= 0.0;\n\
             r = vec4(min(over(0.0), 5.0), min((Z + 2.0) / unset, 6.0), max(a, -7.0), max((Z - 1.0) / zero(), -8.0));",
            [5., 6., -7., -8.],
        ),
        with(
            "void give(out vec2 v) { v = vec2(1.0, 0.0); }",
            "vec2 v; give(v); vec2 q = (Z + vec2(3.0)) / v; r = vec4(q.x, min(q.y, 9.0), 0, 0);",
            [3., 9., 0., 0.],
        ),
        // Divisors that become zero by constant folding, by a difference, and in one iteration of a loop.
        case(
            "float k = 1.0; r = vec4(min((Z + 3.0) / (1.0 - k), 5.0), max((Z - 3.0) / (k - 1.0), -6.0), 0, 0);",
            [5., -6., 0., 0.],
        ),
        with(
            "float over(float a, float b) { return clamp(0.5 + (Z + 2.0) / (b - a), 0.0, 1.0); }\n\
             const float steps[3] = float[](1.0, 0.0, 2.0);",
            "float u = Z + 3.0, s = 0.0; for (int i = -2; i <= 2; i++) s += clamp(0.5 + (Z + 1.0) / float(i), 0.0, 1.0);\n\
             float t = 0.0; for (int i = 0; i < 3; i++) t += clamp((Z + 1.0) / steps[i], 0.0, 4.0);\n\
             r = vec4(s, t, over(2.0, 2.0), min((Z + 1.0) / (u - u), 7.0));",
            [3., 5.5, 1., 7.],
        ),
        // Zeros that functions store in their out parameters and in global variables, and products with them.
        with(
            "float kept = 1.0; void set() { kept = 0.0; } void clear(out float v) { v = 0.0; }\n\
             float within(out float v) { v = 0.0; return (Z + 1.0) / v; }",
            "float k; clear(k); float u; float w = within(u); set();\n\
             r = vec4(min((Z + 1.0) / k, 5.0), min(w, 6.0), min((Z + 1.0) / kept, 7.0), min((Z + 1.0) / (k * Z), 8.0));",
            [5., 6., 7., 8.],
        ),
        with(
            "const vec2 none = vec2(0.0);",
            "float one = 1.0; r = vec4(min(abs((Z + 1.0) / mix(none.x, 0.0, Z)), 5.0), min((Z + 2.0) / (one * 0.0), 6.0),\n\
             max((Z - 1.0) / abs(min(one, 0.0)), -7.0), min((Z + 3.0) / dot(none, vec2(1.0 + Z)), 8.0));",
            [5., 6., -7., 8.],
        ),
        // Shaders repeat space along only some axes by `mod` with a zero.
        case("r = vec4(mod(Z + 5.5, 0.0), mod(vec2(Z + 5.5), vec2(0.0, 2.0)), 0);", [5.5, 5.5, 1.5, 0.]),
    ]);
}

#[test]
fn negative_floats_become_zero_as_uints() {
    check(&[case(
        "r = vec4(uint(Z - 1.5), uint(Z - 3000.0), uint(Z + 7.9), uvec2(Z - 4.0, Z + 4.0).y);",
        [0., 0., 7., 4.],
    )]);
}

/// Section 8.3 defines `mix` as `x (1 - a) + y a`, which equals one of its ends if `a` is 0 or 1; a sum
/// `x + a (y - x)` would lose digits of a small number next to a large one.
#[test]
fn mix_by_zero_or_one_is_exact() {
    check(&[
        case("float x = Z + 18.721829; r = vec4(mix(1000.0, x, step(Z, 1.0)) == x, 0, 0, 0);", [1., 0., 0., 0.]),
        case(
            "float x = Z + 18.721829, hit = step(Z, 1.0) * step(Z + 1.0, x);\n\
             r = vec4(mix(1e9, x, hit) == x, mix(1e9, x, min(hit, float(Z < 1.0))) == x, mix(x, 1e9, 1.0 - hit) == x, \
             0);",
            [1., 1., 1., 0.],
        ),
        case(
            "vec2 x = Z + vec2(0.1, 0.2); vec2 m = mix(vec2(1e9), x, vec2(greaterThan(x, vec2(0.15))));\n\
             r = vec4(m.x, m.y == x.y, 0, 0);",
            [1e9, 1., 0., 0.],
        ),
    ]);
}

/// OpenGL's compilers sum starting with the last component, and multiply matrices from the left (`lower/geometry.rs`).
#[test]
fn products_are_summed_from_the_last_component() {
    insta::assert_snapshot!(ir::optimised(
        "void mainImage(out vec4 o, vec2 p) {\n\
             mat2 m = mat2(p, p.yx), n = mat2(p.x, 1, 2, p.y);\n\
             o = vec4(dot(p, vec2(12.98, 96.77)) + 0.6, p * m, 0);\n\
             o.zw += m * n * p;\n\
         }",
        Driver::default()
    ));
}

/// The checker folds constants to the same values that the device computes (`check/fold_builtin.rs`).
#[test]
fn folded_constants_equal_the_values_of_the_device() {
    let Some(gpu) = gpu() else { return };
    if gpu.info.device_type != wgpu::DeviceType::Cpu {
        return skipped("this device may round differently");
    }
    check_optimised(&[case(
        "vec2 v = vec2(0.2, 1); r = vec4(cos(Z + 0.3) == cos(0.3), acos(Z + 0.3) == acos(0.3),\n\
         normalize(Z + v) == normalize(v), smoothstep(0.0, 1.0, Z + 0.3) == smoothstep(0.0, 1.0, 0.3));",
        [1.; 4],
    )]);
}

/// GPUs return the number of a number and NaN; programs rely on that where they take the root or the power of a negative
/// number.
#[test]
fn extremes_ignore_nan() {
    let Some(mut gpu) = gpu() else { return };
    for replaces in [gpu.nan_extremes, true] {
        gpu.nan_extremes = replaces;
        let cases = [
            case(
                "float n = sqrt(Z - 1.0), a = Z + 3.0; r = vec4(max(a, n), max(n, a), min(a, n), min(n, a));",
                [3.; 4],
            ),
            case(
                "float n = pow(Z - 1.0, 8.0); vec2 v = max(vec2(n, Z + 2.0), vec2(Z)); r = vec4(max(0.0, n), v, clamp(n, 3.0, 9.0));",
                [0., 0., 2., 3.],
            ),
        ];
        check_on(&gpu, &cases, false);
    }
}

/// In Direct3D the angle of (0, 0) is NaN; the device of this test returns some number.
#[test]
fn the_angle_of_a_zero_vector_is_defined() {
    let Some(mut gpu) = gpu() else { return };
    gpu.nan_angle = true;
    // The device does not check the signs of zeros, although IEEE 754 does.
    let either = case(
        "r = vec4(atan(Z, Z), atan(-Z, -Z), atan(vec2(Z, 1.0), vec2(Z)));",
        [0., 0., 0., std::f32::consts::FRAC_PI_2],
    );
    check_on(&gpu, &[either], false);
    let known = case(
        "r = vec4(atan(Z, Z - 1.0), atan(Z - 1.0, Z), atan(0.0, Z), atan(2.0, Z + 2.0));",
        [std::f32::consts::PI, -std::f32::consts::FRAC_PI_2, 0., std::f32::consts::FRAC_PI_4],
    );
    check_on(&gpu, &[known], true);
}

/// A zero that moves from variable to variable against the order of a loop reaches the divisor after as many
/// iterations; if there are more than the analysis follows, any divisor may be zero.
#[test]
fn a_zero_that_moves_through_many_variables_is_hidden() {
    let program = |count: usize, last: f32| {
        let declared: String = (0..count).map(|i| format!("float v{i} = 1.0; ")).collect();
        let moved: String = (1..count).rev().map(|i| format!("v{i} = v{}; ", i - 1)).collect();
        let divided = format!("s += p.x / v{}; {moved}v0 = {last:?};", count - 1);
        let looped = format!("{declared}float s = 0.0; for (int i = 0; i < 200; i++) {{ {divided} }}");
        ir::optimised(&format!("void mainImage(out vec4 o, in vec2 p) {{ {looped} o = vec4(s); }}"), Driver::default())
    };
    for (count, last, is_hidden) in [(20, 0.0, true), (80, 0.0, true), (20, 2.0, false)] {
        assert_eq!(program(count, last).contains("opaque_zero"), is_hidden, "{count} variables, {last}");
    }
}

/// Values of one call are distinguished from those of another call, and the initial zero of a global variable counts
/// only where it may be read.
#[test]
fn only_divisors_that_may_be_zero_are_hidden() {
    let hides = |declared: &str, body: &str| {
        let code = format!("{declared} void mainImage(out vec4 o, in vec2 p) {{ {body} }}");
        ir::optimised(&code, Driver::default()).contains("opaque_zero")
    };
    let capsule = "float along(vec3 p, vec3 a, vec3 b) { vec3 ab = b - a; return dot(p - a, ab) / dot(ab, ab); }";
    let hides_in_calls = |calls: &str| hides(capsule, &format!("vec3 q = p.xyx; o = vec4({calls});"));
    let three =
        "along(q, vec3(0), vec3(1, 0, 0)) + along(q, vec3(0), vec3(0, 1, 0)) + along(q, vec3(2), vec3(0, 0, 1))";
    assert!(!hides_in_calls(three));
    assert!(hides_in_calls(&format!("{three} + along(q, vec3(1, 2, 3), vec3(1, 2, 3))")));
    let scale = "float k; void set() { k = iResolution.y; } float over(float x) { return x / k; }";
    let hides_in_body = |body: &str| hides(scale, body);
    assert!(!hides_in_body("k = iResolution.x; o = vec4(over(p.x));"));
    assert!(!hides_in_body("set(); o = vec4(over(p.x));"));
    assert!(!hides_in_body("if (p.x > 3.0) set(); else k = p.y; for (int i = 0; i < 3; i++) o += over(p.x);"));
    for may_be_first in [
        "o = vec4(over(p.x)); set();",
        "if (p.x > 3.0) set(); o = vec4(over(p.x));",
        "for (int i = 0; i < int(p.x); i++) set(); o = vec4(over(p.x));",
        "if (p.x > 3.0) { k = p.y; o = vec4(1); return; } o = vec4(over(p.x));",
    ] {
        assert!(hides_in_body(may_be_first), "{may_be_first}");
    }
    check(&[
        with(
            "float along(vec2 q, vec2 a, vec2 b) { vec2 ab = b - a; return dot(q - a, ab) / dot(ab, ab); }",
            "vec2 q = vec2(Z + 3.0, Z + 4.0);\n\
             r = vec4(along(q, vec2(0), vec2(2, 0)), along(q, vec2(0, 2), vec2(0, 4)), min(abs(Z + 1.0) / along(q, vec2(0), vec2(2, 0)), 9.0), 0);\n\
             r.w = clamp(0.5 + 1.0 / (along(q, vec2(3, 4), vec2(5, 6)) * 0.0 + Z), 0.0, 2.0);",
            [1.5, 1., 1. / 1.5, 2.],
        ),
        with(
            "float k; float over(float x) { return min(x / k, 7.0); }",
            "float early = over(Z + 1.0); k = Z + 2.0; r = vec4(early, over(Z + 6.0), 0, 0);",
            [7., 3., 0., 0.],
        ),
    ]);
}

/// `discard` ends the shader (section 6.4), and so it ends loops that are running or come later.
#[test]
fn loops_end_after_a_discard() {
    let driver = Driver { discard_exits: true, ..Driver::default() };
    let exits = |declared: &str, body: &str| {
        let code = format!("{declared} void mainImage(out vec4 o, in vec2 p) {{ o = vec4(0); {body} }}");
        ir::optimised(&code, driver).matches("bool = load @").count()
    };
    let (test, sum) = ("if (p.x > 9.0) discard;", "for (int i = 0; i < 99; i++) o += sin(p.x * float(i));");
    assert_eq!(exits("", sum), 0);
    assert_eq!(exits("", &format!("{test} {sum}")), 1);
    assert_eq!(exits("", &format!("{sum} {test}")), 0, "a loop before the discard is unchanged");
    assert_eq!(exits("", &format!("{sum} {test} {sum} {sum}")), 2);
    assert_eq!(exits("", &format!("for (int j = 0; j < 50; j++) {{ {sum} if (o.x > 2.0) discard; }}")), 2);
    assert_eq!(exits("", &format!("if (p.y > 2.0) {{ {sum} }} else {{ {test} {sum} }} {sum}")), 2);
    let functions = format!("void leave(vec2 p) {{ {test} }} vec4 far(vec2 p) {{ vec4 o = vec4(0); {sum} return o; }}");
    assert_eq!(exits(&functions, "leave(p); o = far(p);"), 1);
    assert_eq!(exits(&functions, "o = far(p); leave(p);"), 0);
    assert_eq!(exits("", &format!("{test} if (p.y > 2.0) discard; o = vec4(1);")), 0, "there is no loop");
    // The pixel that is drawn runs all iterations; no helper invocation replaces it.
    check(&[
        case(
            "r = vec4(0); if (Z > 0.0) discard; for (int i = 0; i < 9; i++) r += vec4(i, 1, 0, 0);",
            [36., 9., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 9; i++) { if (Z + float(i) > 8.5) discard; r.x += 2.0; }",
            [18., 0., 0., 0.],
        ),
    ]);
}

/// Small arrays that are built in one expression are read by selecting among their elements, where that is faster.
#[test]
fn small_arrays_are_read_by_selection() {
    let driver = Driver { small_arrays: true, ..Driver::default() };
    let indexes = |body: &str| {
        let code = format!(
            "void change(inout vec2 a[3]) {{ a[1] = vec2(0); }} void mainImage(out vec4 o, in vec2 p) {{ o = vec4(0); int n = int(p.y); {body} }}"
        );
        ir::indices(&ir::optimised(&code, driver)).lines().count()
    };
    let three = "vec2 a[3] = vec2[](p, p * 2.0, p + 1.0);";
    let selected = [
        format!("{three} o.xy = a[n % 3];"),
        format!("{three} o.x = a[n % 3].y;"),
        format!("for (int i = 0; i < n; i++) {{ {three} if (i > 3) o.xy += a[i % 3]; else o.x += a[(i + 1) % 3].x; }}"),
    ];
    let unchanged = [
        "vec2 a[3]; o.xy = a[n % 3];".to_owned(),
        format!("{three} a[n % 3] = p; o.xy = a[n % 2];"),
        format!("{three} a[1].x = 4.0; o.xy = a[n % 3];"),
        format!("{three} change(a); o.xy = a[n % 3];"),
        "vec2 a[3]; for (int i = 0; i < n; i++) { o.xy += a[i % 3]; a = vec2[](p, p * 2.0, p + 1.0); }".to_owned(),
        "vec2 a[3]; if (n > 2) a = vec2[](p, p * 2.0, p + 1.0); o.xy = a[n % 3];".to_owned(),
        "float a[9] = float[](p.x, 1., 2., 3., 4., 5., 6., 7., p.y); o.x = a[n % 9];".to_owned(),
    ];
    for body in &selected {
        assert_eq!(indexes(body), 0, "{body}");
    }
    for body in &unchanged {
        assert_ne!(indexes(body), 0, "{body}");
    }
    let Some(mut gpu) = gpu() else { return };
    for scatters in [false, true] {
        gpu.scatters_arrays = scatters;
        let cases = [
            case(
                "vec3 a[4] = vec3[](vec3(Z), vec3(Z + 1.0, 5, 6), vec3(7, Z, 8), vec3(Z + 3.0));\n\
                 int n = int(Z); r = vec4(a[n + 1].yz, a[n + 2].x, a[n + 3].z);",
                [5., 6., 7., 3.],
            ),
            case(
                "for (uint i = 0u; i < 4u; i++) { int a[4] = int[](int(Z), 10, 20, int(i)); r[i] = float(a[3u - i] + int(i)); }",
                [0., 21., 12., 3.],
            ),
            case(
                "bool a[2] = bool[](Z > 0.5, Z < 0.5); int n = int(Z); r = vec4(a[n], a[n + 1], a[n + 7], a[n - 3]);",
                [0., 1., 1., 0.],
            ),
        ];
        check_on(&gpu, &cases, true);
    }
}

/// A short loop that is the limit of an inner loop over an array is unrolled; others are left to the driver.
#[test]
fn short_loops_around_array_loops_are_unrolled() {
    let loops = |body: &str| {
        let code = format!(
            "void mainImage(out vec4 o, in vec2 p) {{ o = vec4(0); vec2 a[4]; for (int i = 0; i < 4; i++) a[i] = p * float(i * i); {body} }}"
        );
        ir::optimised(&code, Driver::default()).matches("loop {").count() - 1
    };
    let inner = "for (int i = 0; i < n; i++) a[i] = mix(a[i], a[i + 1], p.x);";
    assert_eq!(loops(&format!("int n = 3; while (n > 0) {{ {inner} n--; }} o.xy = a[0];")), 3);
    assert_eq!(loops(&format!("for (int n = 3; n >= 1; n -= 1) {{ {inner} }} o.xy = a[0];")), 3);
    assert_eq!(loops(&format!("for (int n = 0; n != 4; n++) {{ {inner} if (p.y > 3.0) return; }} o.xy = a[0];")), 4);
    for unchanged in [
        format!("for (int n = 3; n > 0; n--) {{ {inner} if (p.y > 3.0) break; }}"),
        format!("for (int n = 3; n > 0; n--) {{ if (p.y > 3.0) continue; {inner} }}"),
        format!("for (int n = 3; n > int(p.x); n--) {{ {inner} }}"),
        format!("for (int n = int(p.x); n > 0; n--) {{ {inner} }}"),
        format!("for (int n = 3; n > 0; n--) {{ {inner} if (p.y > 3.0) n--; }}"),
        "for (int n = 3; n > 0; n--) for (int i = 0; i < n; i++) o += sin(p.x + float(i));".to_owned(),
        "for (int n = 3; n > 0; n--) for (int i = 0; i < 3; i++) a[i] += a[i + 1];".to_owned(),
        "for (int n = 30; n > 0; n--) for (int i = 0; i < min(n, 3); i++) a[i] += a[i + 1];".to_owned(),
    ] {
        assert_eq!(loops(&format!("{unchanged} o.xy = a[0];")), 2, "{unchanged}");
    }
    check(&[
        case(
            "float a[4] = float[](Z + 1.0, Z + 2.0, Z + 4.0, Z + 8.0); int n = 3;\n\
             while (n > 0) { for (int i = 0; i < n; i++) a[i] = mix(a[i], a[i + 1], 0.5); n--; }\n\
             r = vec4(a[0], a[1], a[2], n);",
            [3.375, 4.5, 6., 0.],
        ),
        case(
            "float a[3] = float[](Z, Z, Z); int n;\n\
             r.w = 0.0; for (n = -1; n < 3; n += 2) { int m = n; for (int i = 0; i <= m + 1; i++) a[i] += float(m * 10 + n + i); r.w += 1.0; }\n\
             r.xyz = vec3(a[0] + a[1], a[2], n);",
            [-11. + 11. + 12., 13., 3., 2.],
        ),
    ]);
}

/// Only a value that a loop changes can count down to a limit; the counter of another loop is left unchanged, so that
/// the driver knows its number of iterations.
#[test]
fn limits_are_hidden_only_if_a_value_counts_down_to_them() {
    let module = |body: &str, opaque_limits: bool| {
        let code = format!(
            "int g; void f() {{ g--; }} void mainImage(out vec4 o, in vec2 p) {{ o = vec4(0); int m = int(p.x), n = 4; \
             if (p.y > 9.0) n = 5; g = m; {body} }}"
        );
        let driver = Driver { opaque_limits, ..Driver::default() };
        let compiled = glsl::compile(&PassSource { driver, ..PassSource::image(&code) });
        format!("{:?}", compiled.unwrap_or_else(|errors| panic!("{code}: {errors:?}")).module)
    };
    let is_hidden = |body: &str| module(body, true) != module(body, false);
    for body in [
        "for (int i = 0; i < n; i++) o += sin(p.x + float(i));",
        "for (int i = 0; i < m; i++) o += sin(p.x + float(i));",
        "for (int i = 0; i < g; i++) o += sin(p.x + float(i));",
        "for (int i = 0; i <= n - m; i++) o += sin(p.x + float(i));",
        "for (int j = 0; j < 3; j++) { n = j; for (int i = 0; i < n; i++) o += sin(p.x + float(i)); }",
        "for (int i = 0;; i++) { if (i >= n) break; o += sin(p.x + float(i)); }",
        "for (int i = 9; i > 2; i--) o += sin(p.x + float(i));",
    ] {
        assert!(!is_hidden(body), "{body}");
    }
    for body in [
        "for (int i = 9; i > n; i--) o += sin(p.x + float(i));",
        "for (int i = 9; n < i; i--) o += sin(p.x + float(i));",
        "for (int i = m; i < n; n--) o += sin(p.x + float(i));",
        "for (int i = 0; i < g; i++) { f(); o += sin(p.x + float(i)); }",
        "while (g > m) { f(); o += sin(p.x); }",
        "for (int i = 9;; i--) { for (int j = 0; j < 2; j++) if (i <= m) return; o += sin(p.x); }",
    ] {
        assert!(is_hidden(body), "{body}");
    }
}

/// The behaviour of an infinite loop is up to the platform (section 6.3): where a driver could not stop it, it is
/// ended.
#[test]
fn infinite_loops_are_ended() {
    // The iterations of all infinite loops of a pixel are counted together; other loops are not limited.
    let Some(mut gpu) = gpu() else { return };
    gpu.max_loop_iterations = Some(1_000);
    let limit = 1_000.0;
    check_on(
        &gpu,
        &[
            case("r = vec4(0); while (Z < 1.0) r.x += 1.0; r.y = 3.0;", [limit, 3., 0., 0.]),
            case(
                "r = vec4(0); while (r.x < 5.0 - Z) r.x++; for (int i = 0; i < 9; i++) { while (r.y >= Z) r.y++; r.z++; \
                 for (int j = 0; j < 7; j++) r.w++; }",
                [5., limit - 6., 9., 63.],
            ),
        ],
        false,
    );
}
