use super::*;
use crate::{CustomUniform, CustomUniformKind, PassSource, TexelUse, UniformSet, compile};

/// Returns what an image pass with the uniforms `float k` and `int n` reads at these values.
fn reads(k: f32, n: i32, text: &str) -> Reads {
    let uniforms =
        [CustomUniform::new("k", CustomUniformKind::Float, 0), CustomUniform::new("n", CustomUniformKind::Int, 1)];
    let source = PassSource { custom_uniforms: &uniforms, ..PassSource::image(text) };
    let compiled = compile(&source).unwrap();
    compiled.specialisable.unwrap().reads(&[[k.to_bits(), 0, 0, 0], [n as u32, 0, 0, 0]])
}

/// Returns whether a pass of these statements reads `iTime`.
fn reads_time(k: f32, n: i32, code: &str) -> bool {
    let text = format!("{FUNCTIONS}\nvoid mainImage(out vec4 c, in vec2 p) {{ c = vec4(0); {code} }}");
    reads(k, n, &text).uniforms.contains(UniformSet::TIME)
}

const FUNCTIONS: &str = "
float own;
vec2 turned(vec2 p, float a) { return mat2(cos(a), sin(a), -sin(a), cos(a)) * p; }
void camera(float time, out vec3 from) { float a = 0.45 * sin(k * time); from = vec3(a, 0.0, 1.0); }
void set() { own = k * iTime; }
float speed() { return k; }
vec4 later(float t) { if (n > 0) return vec4(t); return vec4(1); }";

#[test]
fn time_times_zero_is_not_read() {
    for code in [
        "c.xy = turned(p, k * iTime);",
        "c.xy = turned(p, -0.2 * (iTime * k));",
        "float t = iTime; t *= k; c.x = t;",
        "vec3 from; camera(iTime, from); c.xyz = from;",
        "set(); c.x = own;",
        "c.x = speed() * iTime;",
        "c.x = 13.7 * floor(k * iTime);",
        "c.xyz = vec3(1, 2, 3) + k * vec3(iTime, 0.0, 2.0 * iTime);",
        "c.x = 2.0 + k * sin(iTime);",
        "c.x = mix(2.0, iTime, k);",
        "if (k > 0.0) c.x = iTime;",
        "c.x = k > 0.0 ? iTime : 1.0;",
        "for (int i = 0; i < n; i++) c.x += iTime;",
        "for (float x = 0.5; x < k; x++) c.x += iTime;",
        "if (n == 3) { c.x = iTime; } else if (n == 0) { c.x = 1.0; } else { c.y = iTime; }",
        "switch (n) { case 1: c.x = iTime; break; case 0: c.x = 1.0; break; default: c.x = iTime; }",
        "c = later(iTime);",
        "float a[2]; if (k != 0.0) return; c.x = 1.0;",
    ] {
        assert!(!reads_time(0.0, 0, code), "{code}");
        let is_always_read = code.contains("iTime") || code.contains("set()");
        assert_eq!(reads_time(1.0, 3, code), is_always_read, "{code}");
    }
}

#[test]
fn what_may_differ_in_a_bit_is_read() {
    for code in [
        "c.x = k * sin(iTime);",                        // 0 or -0
        "c.x = sign(1.0 / (k * -iTime));",              // -0
        "c.x = k * (1.0 / iTime);",                     // NaN at frame 0
        "c.x = k * exp(iTime);",                        // NaN from infinity
        "c.x = k * log(iTime);",                        // NaN from infinity
        "c.x = k * pow(2.0, iTime);",                   // NaN from infinity
        "c.x = k * texture(iChannel0, vec2(iTime)).x;", // a texel may be NaN
        "c.x = mix(-0.0, sin(iTime), k);",
        "float t = iTime; for (int i = 0; i < 3; i++) { c.x += t; t *= k; }",
        "float t = 0.0; if (p.x > 3.0) t = iTime; c.x = t;",
        "own = iTime; if (p.x > 3.0) own = k; c.x = own;",
        "vec3 v = vec3(0); v[int(p.x)] = iTime; c.xyz = v;",
        "c.x = iTime; if (p.x > 3.0) { c.x = k; }",
        "float t = k; while (true) { if (t > 0.5) break; t += iTime; } c.x = t;",
        "float t = iTime; { float s = t; t = k; c.x = s; }",
    ] {
        assert!(reads_time(0.0, 0, code), "{code}");
    }
    assert!(reads_time(-0.0, 0, "c.x = k * iTime;"), "the sign of this zero is not tracked");
    assert!(reads_time(1e-40, 0, "c.x = k * iTime;"), "a device may flush it to zero, or not");
    assert!(reads_time(f32::NAN, 0, "c.x = k * iTime;"));
    assert!(reads_time(0.1, 0, "if (k * 3.0 > 0.3) c.x = iTime;"), "depends on the rounding");
    assert!(!reads_time(0.1, 0, "if (k * 3.0 > 0.31) c.x = iTime;"));
}

#[test]
fn channels_are_read_only_where_their_branch_is_taken() {
    let text = "void mainImage(out vec4 c, in vec2 p) {
        c = texelFetch(iChannel0, ivec2(p), 0);
        if (n > 1) c += texture(iChannel1, p);
        if (k > 0.5 && p.x > 3.0) discard;
        c.x += float(textureSize(iChannel2, 0).x);
        c.y += texelFetch(iChannel3, ivec2(3, 4), 0).x + texelFetch(iChannel3, ivec2(0), 0).x + texelFetch(iChannel3, ivec2(3, 4), 0).y;
    }";
    let texels = |reads: &Reads| [0, 1, 2, 3].map(|channel: usize| reads.channels[channel].texels);
    let all = reads(1.0, 2, text);
    assert_eq!(texels(&all), [TexelUse::Any, TexelUse::Any, TexelUse::None, TexelUse::Fixed(2)]);
    assert!(all.discards && all.channels[1].mips && all.channels[2].texture);
    let rest = reads(0.0, 1, text);
    assert_eq!(texels(&rest), [TexelUse::Any, TexelUse::None, TexelUse::None, TexelUse::Fixed(2)]);
    assert!(!rest.discards && !rest.channels[1].texture);
}
