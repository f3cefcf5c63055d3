//! What the specification leaves open and pictures lean on: as OpenGL drivers and browsers have it, on whatever driver
//! draws.
//!
//! `Z` is a zero no compiler can see through, so that nothing here is folded before it runs.

use crate::support::{compute::*, ir, *};
use eddy::glsl::Driver;

/// Drivers take a quotient by a zero they can see for anything.
#[test]
fn a_constant_zero_divides() {
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
        // Constants that are folded, spread and counted to a zero.
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
        // Zeros that functions leave in what they are handed and in variables of the module, and what they multiply.
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
        // Space is repeated along some axes alone by this.
        case("r = vec4(mod(Z + 5.5, 0.0), mod(vec2(Z + 5.5), vec2(0.0, 2.0)), 0);", [5.5, 5.5, 1.5, 0.]),
    ]);
}

#[test]
fn negative_floats_as_uints() {
    check(&[case(
        "r = vec4(uint(Z - 1.5), uint(Z - 3000.0), uint(Z + 7.9), uvec2(Z - 4.0, Z + 4.0).y);",
        [0., 0., 7., 4.],
    )]);
}

/// Section 8.3 writes `mix` as `x (1 - a) + y a`, which is one of its ends where `a` is 0 or 1: no sum `x + a (y - x)`
/// keeps all of a small number beside a large one.
#[test]
fn mix_by_a_condition() {
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

/// OpenGL's compilers sum from the last component on, and multiply matrices from the left (`lower/geometry.rs`).
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

/// The checker computes constants as the device computes them (`check/fold_builtin.rs`).
#[test]
fn constants_are_as_the_device_computes_them() {
    let Some(gpu) = gpu() else { return };
    if gpu.info.device_type != wgpu::DeviceType::Cpu {
        return skipped("this device may round otherwise");
    }
    check_optimised(&[case(
        "vec2 v = vec2(0.2, 1); r = vec4(cos(Z + 0.3) == cos(0.3), acos(Z + 0.3) == acos(0.3),\n\
         normalize(Z + v) == normalize(v), smoothstep(0.0, 1.0, Z + 0.3) == smoothstep(0.0, 1.0, 0.3));",
        [1.; 4],
    )]);
}

/// Direct3D has no number for the angle of (0, 0); this device has some number or other.
#[test]
fn the_angle_of_nowhere() {
    let Some(mut gpu) = gpu() else { return };
    gpu.nan_angle = true;
    // Which zeros are negative the device does not ask, but IEEE 754 does.
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

/// A zero that goes from variable to variable against the order of a loop reaches the divisor after as many rounds; where
/// these are more than are followed, any divisor may be a zero.
#[test]
fn a_zero_that_comes_by_a_long_way_is_hidden() {
    let program = |count: usize, last: f32| {
        let declared: String = (0..count).map(|i| format!("float v{i} = 1.0; ")).collect();
        let handed_on: String = (1..count).rev().map(|i| format!("v{i} = v{}; ", i - 1)).collect();
        let divided = format!("s += p.x / v{}; {handed_on}v0 = {last:?};", count - 1);
        let looped = format!("{declared}float s = 0.0; for (int i = 0; i < 200; i++) {{ {divided} }}");
        ir::optimised(&format!("void mainImage(out vec4 o, in vec2 p) {{ {looped} o = vec4(s); }}"), Driver::default())
    };
    for (count, last, is_hidden) in [(20, 0.0, true), (80, 0.0, true), (20, 2.0, false)] {
        assert_eq!(program(count, last).contains("opaque_zero"), is_hidden, "{count} variables, {last}");
    }
}
