//! Integer divisions that trap on a processor: they do not end the process, and each has the value that WGSL defines.

use crate::support::{compute::*, program::Bench};

/// The smallest int.
const LEAST: &str = "(-2147483647 - 1)";

/// Expressions that drivers recognise as zero, -1 or the smallest int after constant propagation.
const TRAPPING_CODE: &[&str] = &[
    "int x = LEAST / (int(p.x) * 0 - 1); o = vec4(x);",
    "int x = LEAST % (int(p.x) * 0 - 1); o = vec4(x);",
    "int x = 5 / (int(p.x) * 0); o = vec4(x);",
    "int x = 5 % (int(p.x) * 0); o = vec4(x);",
    "uint x = 5u / (uint(p.x) * 0u) + 5u % (uint(p.x) * 0u); o = vec4(x);",
    "ivec4 x = ivec4(LEAST) / ivec4(int(p.x) * 0 - 1); o = vec4(x % (ivec4(p.xyxy) * 0 - 1));",
    "ivec3 x = ivec3(LEAST, 7, LEAST) / (int(p.x) * 0 - 1); o = vec4(LEAST % (ivec3(p.xyx) * 0 - 1), x.y);",
    "ivec2 x = LEAST / ivec2(int(p.x) * 0 - 1, int(p.x) * 0); x %= ivec2(p) * 0; o = vec4(x, x);",
    "uvec4 x = uvec4(9u) / uvec4(uint(p.x) * 0u); x %= uint(p.x) * 0u; o = vec4(x);",
    "int x = LEAST; x /= int(p.x) * 0 - 1; x %= int(p.x) * 0 - 1; x /= int(p.x) * 0; o = vec4(x);",
    "int x = LEAST + int(p.x) * 0; o = vec4(x / -1, x % -1, -x, abs(x));",
    "int x = LEAST + int(p.x) * 0; o = vec4(ivec2(x) / ivec2(-1, 3), ivec2(x) % ivec2(-1, 0));",
    "const int x = LEAST / -1, y = LEAST % -1; o = vec4(x, y, LEAST / -1, ivec2(LEAST).y / -1);",
    // Loops that are unrolled, functions that are inlined, and selections whose both sides are computed.
    "int x = 0; for (int i = -1; i < 2; i++) x += LEAST / i + LEAST % i; o = vec4(x);",
    "int x = 0; for (uint i = 0u; i < 3u; i++) x += int(9u / i) + int(9u % i); o = vec4(x);",
    "o = vec4(quotient(LEAST, -1), quotient(1, 0), remainder(LEAST, -1), remainder(1, 0));",
    "int d = int(p.x) * 0; int x = d != 0 ? LEAST / d : 3; o = vec4(x, d == -1 ? 0 : LEAST % (d - 1), 0, 0);",
    "int d = int(p.x) * 0; if (d > 5) o = vec4(LEAST / d); else if (d < 0) o = vec4(7 % d); else o = vec4(1);",
    "int d = int(p.x) * 0; for (int i = 0; i < 40; i++) { d = min(d, 0); o.x += float((LEAST + i * 0) / (d - 1)); }",
    // A loop without iterations: the bounds of its counter are 1 and 0.
    "o = vec4(0); for (int i = 1; i < 1; i++) o.x += float(7 / i / 3 + 5 % (7 / i));",
    "int s = int(p.x) * 0; o = vec4(1 << (s + 33), 1 >> (s - 1), 8u >> (s + 64), -1 << (s + 32));",
    "float f = p.x * 0.0; o = vec4(int(1e30 + f), int(-1e30 + f), uint(1e30 + f), int(f / (f * f)));",
    "float f = float(int(p.x) * 0); o = vec4(int(1.0 / f), uint(-1.0 / f), int(f / f), int(sqrt(f - 1.0)));",
];

const FUNCTIONS: &str = "int quotient(int n, int d) { return n / d; }\nint remainder(int n, int d) { return n % d; }\n";

#[test]
fn divisions_do_not_end_the_process() {
    let Some(b) = Bench::with_gpu() else { return };
    // Each in its own program, so that one does not mask another; several per call, to save time.
    let mut names = Vec::new();
    for (i, body) in TRAPPING_CODE.iter().enumerate() {
        let name = format!("trap_{i}.glsl");
        let text =
            format!("{FUNCTIONS}void mainImage(out vec4 o, in vec2 p) {{\n{}\n}}\n", body.replace("LEAST", LEAST));
        b.write(&name, text);
        names.push(name);
    }
    for batch in names.chunks(6) {
        let mut args = vec!["render"];
        args.extend(batch.iter().map(String::as_str));
        args.extend(["--size", "8x4", "--frames", "2", "--out", "pictures"]);
        let run = b.eddy(&args);
        assert_eq!(run.code, Some(0), "{batch:?}: {}", run.err);
    }
    assert_eq!(b.names("pictures").len(), TRAPPING_CODE.len());
    for (name, body) in names.iter().zip(TRAPPING_CODE) {
        assert_walker_agrees(&b, &format!("{name} --pixel 3,1"), body);
    }
}

/// Asserts that the walker computes the same value of a pixel as the device.
fn assert_walker_agrees(b: &Bench, args: &str, what: &str) {
    let run = b.line(&format!("trace {args} --size 8x4 --frame 1 --json")).expect(0);
    let line = &run.json()[0];
    assert_eq!(line["ulps"], serde_json::json!([0, 0, 0, 0]), "{what}: {} not {}", line["value"], line["device"]);
}

#[test]
fn divisions_in_a_vertex_stage_do_not_end_the_process() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write(
        "scene/eddy.toml",
        "eddy = 1\nname = \"scene\"\n\n[passes.buffer_scene]\ntargets = [\"rgba32f\"]\nsize = [8, 4]\n\
         draw = [{ mesh = \"builtin:cube\", vertex = \"v.glsl\", fragment = \"f.glsl\" }]\n\n\
         [passes.image]\nchannels.0 = { buffer = \"scene\", filter = \"nearest\" }\n",
    );
    let vertex = "in vec3 aPosition;\nflat out int vQ;\nvoid main() {\n\
        int z = int(aPosition.x) * 0, least = LEAST + z, q = LEAST / (z - 1);\n\
        q += least % (z - 1); q /= z; q %= z; ivec3 v = ivec3(least) / (z - 1); v %= ivec3(z);\n\
        vQ = q + v.x;\n gl_Position = vec4(0.5 * aPosition, 1.0);\n}\n";
    b.write("scene/v.glsl", vertex.replace("LEAST", LEAST));
    let fragment = "flat in int vQ;\nlayout(location = 0) out vec4 a;\nvoid main() {\n\
        int z = vQ * 0; a = vec4(LEAST / (z - 1) + 3 % z);\n}\n";
    b.write("scene/f.glsl", fragment.replace("LEAST", LEAST));
    b.write("scene/image.glsl", "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n");
    let run = b.line("render scene --size 8x4 --frames 2 --out scene.png");
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert_walker_agrees(&b, "scene --pass buffer_scene --pixel 4,2", vertex);
}

/// The operands are unknown to the compiler, and constant for the driver once the program runs.
#[test]
fn divisions_have_the_values_of_wgsl() {
    const INTS: &str = "const int LEAST = -2147483647 - 1; float is(int a, int b) { return a == b ? 1.0 : 0.0; }\
        int quotient(int n, int d) { return n / d; } int remainder(int n, int d) { return n % d; }";
    let ones = |body| with(INTS, body, [1.; 4]);
    check(&[
        ones("int z = I; r = vec4(is(5 / z, 5), is(5 % z, 0), is(-5 / z, -5), is((LEAST + z) / z, LEAST));"),
        ones(
            "int n = LEAST + I, m = I - 1; r = vec4(is(n / m, LEAST), is(n % m, 0), is(n / -1, LEAST), is(n % -1, 0));",
        ),
        ones(
            "int z = I, q = 7; q /= z; r.x = is(q, 7); q %= z; r.y = is(q, 0); q = LEAST; q /= z - 1; r.z = is(q, \
             LEAST); r.w = is(7 / (z - 1), -7);",
        ),
        case("r = vec4(5u / U == 5u, 5u % U == 0u, 5u / (U + 2u) == 2u, (U - 1u) / (U - 1u) == 1u);", [1.; 4]),
        ones(
            "ivec4 q = ivec4(LEAST, 7, 7, LEAST) / (ivec4(-1, 0, -1, 0) + I); r = vec4(is(q.x, LEAST), is(q.y, 7), \
             is(q.z, -7), is(q.w, LEAST));",
        ),
        ones(
            "ivec4 q = ivec4(LEAST, 7, 7, LEAST) % (ivec4(-1, 0, -1, 3) + I); r = vec4(is(q.x, 0), is(q.y, 0), is(q.z, \
             0), is(q.w, 1));",
        ),
        ones(
            "ivec2 q = (LEAST + I) / ivec2(I - 1, I), s = ivec2(LEAST, 9) / (I - 1); r = vec4(is(q.x, LEAST), is(q.y, \
             LEAST), is(s.x, LEAST), is(s.y, -9));",
        ),
        ones(
            "ivec2 n = ivec2(LEAST, 9) + I; ivec2 q = n / ivec2(-1, 0), s = n % ivec2(0, -1); r = vec4(is(q.x, LEAST), \
             is(q.y, 9), is(s.x, 0), is(s.y, 0));",
        ),
        // Divisions whose guards can be omitted because of the bounds of the divisor, and others whose guards are
        // needed.
        ones("int s = 0; for (int i = 1; i < 4; i++) s += 12 / i + (I + 13) % i; r = vec4(is(s, 24), 1, 1, 1);"),
        ones("int s = 0; for (int i = 0; i < 3; i++) s = s * 10 + (I + 7) / i; r = vec4(is(s, 773), 1, 1, 1);"),
        ones(
            "int s = 0; for (int i = -1; i < 1; i++) s += (LEAST + I) / i == LEAST ? 1 : 0; r = vec4(is(s, 2), 1, 1, \
             1);",
        ),
        ones(
            "int s = 0; for (int i = 1; i < 4; i -= 2, s += (I + 7) / i) { if (i < 0) break; continue; } r = \
             vec4(is(s, -7), 1, 1, 1);",
        ),
        ones(
            "r = vec4(is(quotient(7, 0), 7), is(quotient(LEAST, -1), LEAST), is(remainder(7, 0), 0), is(remainder(-7, \
             3), 2));",
        ),
        ones(
            "int d = clamp(I, 0, 5), e = (I & 3) + 1; r = vec4(is(9 / d, 9), is(9 % d, 0), is(9 / e, 9), is((LEAST + \
             I) / max(I, 1), LEAST));",
        ),
    ]);
}
