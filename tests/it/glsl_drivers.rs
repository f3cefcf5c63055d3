//! What the specification leaves open and pictures lean on: as OpenGL drivers and browsers have it, on whatever driver
//! draws.
//!
//! `Z` is a zero no compiler can see through, so that nothing here is folded before it runs.

use crate::support::{compute::*, *};

/// Drivers take a quotient by a zero they can see for anything.
#[test]
fn a_constant_zero_divides() {
    check_driver(&[
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
        // Space is repeated along some axes alone by this.
        case("r = vec4(mod(Z + 5.5, 0.0), mod(vec2(Z + 5.5), vec2(0.0, 2.0)), 0);", [5.5, 5.5, 1.5, 0.]),
    ]);
}

/// What is not a number is not nothing, and is cut to zero.
#[test]
fn comparisons_of_nan() {
    check_driver(&[case(
        "float z = Z * 3.0; r = vec4(abs(z) > 0.0, 0.0 < abs(z - 2.0), abs(z) < 0.0, abs(z) > 1.0);",
        [0., 1., 0., 0.],
    )]);
}

#[test]
fn negative_floats_as_uints() {
    check_driver(&[case(
        "r = vec4(uint(Z - 1.5), uint(Z - 3000.0), uint(Z + 7.9), uvec2(Z - 4.0, Z + 4.0).y);",
        [0., 0., 7., 4.],
    )]);
}

/// A mix by what can only be 0 or 1 is a choice: no sum keeps all of a small number beside a large one, or beside NaN.
#[test]
fn mix_by_a_condition() {
    check_driver(&[
        case("r = vec4(floatBitsToUint(mix(1000.0, Z + 18.721829, step(Z, 1.0))) - 0x4195c64eu);", [0.; 4]),
        case(
            "float x = Z + 18.721829, hit = step(Z, 1.0) * step(Z + 1.0, x);\n\
             r = vec4(mix(1e9, x, hit) == x, mix(1e9, x, min(hit, float(Z < 1.0))) == x, mix(x, 1e9, 1.0 - hit) == x, \
             0);",
            [1., 1., 1., 0.],
        ),
        case(
            "vec2 x = Z + vec2(0.1, 0.2); vec2 m = mix(vec2(1e9), x, vec2(greaterThan(x, vec2(0.15))));\n\
             r = vec4(m.x, m.y == x.y, mix(sqrt(Z - 1.0), 3.0, step(Z, 1.0)), 0);",
            [1e9, 1., 3., 0.],
        ),
    ]);
}

/// Which last bits come out, on drivers that neither fuse nor round otherwise: those of OpenGL's compilers.
#[test]
fn order_of_evaluation() {
    let Some(gpu) = gpu() else { return };
    if gpu.info.device_type != wgpu::DeviceType::Cpu {
        return skipped("this device may fuse or round otherwise");
    }
    check_driver(&[
        // What is added to a dot product goes to its last term: x x' + (y y' + 0.6).
        case(
            "vec2 p = Z + vec2(3.69, 6.83); r = vec4(floatBitsToUint(dot(p, vec2(12.98, 96.77)) + 0.6) - 0x44315bdbu);",
            [0.; 4],
        ),
        // Constants reach into vectors: (13.46 t) p.x + (41.74 t) p.y.
        case(
            "vec2 p = Z + vec2(2.59, 8.26); float t = Z + 6.91;\n\
             r = vec4(floatBitsToUint(dot(t * p, vec2(13.46, 41.74)) + 17.34) - 0x452509c2u);",
            [0.; 4],
        ),
        // The width of this step is a negative zero.
        case(
            "float a = Z; r = vec4(smoothstep(a, 0.0, Z - 1.0), smoothstep(a, 0.0, Z + 1.0), 0, 0);",
            [1., 0., 0., 0.],
        ),
        // A scalar that is added to a vector stays whole: p + (p.x q.x + p.y q.y).
        case(
            "vec2 p = Z + vec2(8.69, 6.8), q = Z + vec2(5.33, 3.22);\n\
             r = vec4(floatBitsToUint(p + dot(p, q)) - uvec2(0x4299ceb2u, 0x42960704u), 0, 0);",
            [0.; 4],
        ),
        // x (1 - a) + y a where the components share x (1 - a).
        case(
            "vec3 y = Z + vec3(4.25, 1.0, 2.0); r = vec4(floatBitsToUint(mix(vec3(0.3), y, Z + 0.27).x) - \
             0x3faee979u);",
            [0.; 4],
        ),
        // What both sides of a mix are products with is taken out: p mix(1, 0.3, a).
        with(
            "float fade(float p, float a) { return mix(p, p * 0.3, a); }",
            "r = vec4(floatBitsToUint(fade(Z + 0.737, Z + 0.37)) - 0x3f0bce53u);",
            [0.; 4],
        ),
        // The same where the variable is written to.
        with(
            "float fade(float p, float a) { float v = p; v += 1.0; v = mix(v, v * 0.3, a); return v; }",
            "r = vec4(floatBitsToUint(fade(Z + 0.6, Z + 0.91)) - 0x3f14af4fu);",
            [0.; 4],
        ),
        // The share is a constant: x (1 - cos(0.5)) + y cos(0.5).
        with(
            "float turn(float x, float y, float angle) { return mix(x, y, cos(angle)); }",
            "r = vec4(floatBitsToUint(turn(Z + 2.33, Z + 2.11, 0.5)) - 0x4008c37eu);",
            [0.; 4],
        ),
        // ... but the components of a constant column are several numbers: y 0.27 + x 0.27.
        case(
            "r = vec4(floatBitsToUint(((Z + vec2(5.59, 1.1)) * mat2(0.27, 0.27, -0.27, 0.27)).x) - 0x3fe734d8u);",
            [0.; 4],
        ),
        // A choice between two values is a branch, over which the product that a function gave is not taken apart: (m
        // n) v.
        with(
            "mat2 m, n; mat2 both() { return m * n; }",
            "m = mat2(3.28, 1.51, 7.11, 5.46); n = mat2(1.22, 1.41, 2.04, 3.86); m[0] += Z; n[0] += Z;\n\
             vec2 p = both() * vec2(Z + 7.88, Z > 1.0 ? 1.0 : 8.59);\n\
             r = vec4(floatBitsToUint(p) - uvec2(0x43c9e0e3u, 0x438d573du), 0, 0);",
            [0.; 4],
        ),
        // Those of variables that are used again are not, nor those on the greater side of `<`.
        case(
            "float a = max(Z + 2.29, Z), b = a + 0.62; r = vec4(b < 2.91, b >= 2.91, a + 0.62 > 2.9100001, b - b);",
            [1., 0., 0., 0.],
        ),
        // Constants are what the device computes.
        case(
            "vec2 v = vec2(0.2, 1); r = vec4(cos(Z + 0.3) == cos(0.3), acos(Z + 0.3) == acos(0.3),\n\
             normalize(Z + v) == normalize(v), smoothstep(0.0, 1.0, Z + 0.3) == smoothstep(0.0, 1.0, 0.3));",
            [1.; 4],
        ),
    ]);
}

/// Direct3D has no number for the angle of (0, 0); this device has some number or other.
#[test]
fn the_angle_of_nowhere() {
    let Some(mut gpu) = gpu() else { return };
    gpu.nan_angle = true;
    check_on(
        &gpu,
        &[
            case(
                "r = vec4(atan(Z, Z), atan(-Z, -Z), atan(vec2(Z, 1.0), vec2(Z)));",
                [0., 0., 0., std::f32::consts::FRAC_PI_2],
            ),
            case(
                "r = vec4(atan(Z, Z - 1.0), atan(Z - 1.0, Z), atan(0.0, Z), atan(2.0, Z + 2.0));",
                [std::f32::consts::PI, -std::f32::consts::FRAC_PI_2, 0., std::f32::consts::FRAC_PI_4],
            ),
        ],
    );
}
