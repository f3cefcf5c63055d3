//! The programs that are measured.

use eddy_project::Filter;
use eddy_texture::TexelFormat;

/// A program: `body` runs `rounds` times, `times` copies of it in each round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bench {
    pub name: &'static str,
    body: &'static str,
    times: usize,
    rounds: u32,
    /// The format and the filter of `iChannel0`, if it reads it.
    pub channel: Option<(TexelFormat, Filter)>,
}

const fn bench(name: &'static str, body: &'static str, times: usize) -> Bench {
    Bench { name, body, times, rounds: 48, channel: None }
}

const fn texture(name: &'static str, format: TexelFormat, filter: Filter) -> Bench {
    Bench { name, body: SAMPLES, times: 1, rounds: 16, channel: Some((format, filter)) }
}

const SAMPLES: &str = "x += texture(iChannel0, x.xy * 0.01 + u); y += texture(iChannel0, y.xy * 0.01 + u.yx);";

/// Each operation uses the result of another, in four lanes at once as most code does. Values may become infinite:
/// that takes no longer.
pub(super) const BENCHES: &[Bench] = &[
    bench("empty", "", 0),
    bench("sums and products", "x = x * y + z; y = y * x + z;", 4),
    bench("products", "x *= y; y *= x;", 6),
    bench("quotients", "x = y / x; y = x / y;", 4),
    bench("roots", "x = sqrt(x + y); y = inversesqrt(y + x);", 3),
    bench("exponentials", "x = exp(x - y); y = log(y + x);", 2),
    bench("powers", "x = pow(x, y); y = pow(y, x);", 1),
    bench("sines", "x = sin(x); y = cos(y);", 2),
    bench("tangents", "x = tan(x); y = tan(y);", 1),
    bench("arcs", "x = atan(x); y = asin(y);", 1),
    bench("angles", "x = atan(x, y); y = acos(y);", 1),
    bench("extremes", "x = min(x + y, z); y = max(y + x, z);", 4),
    bench("magnitudes", "x = abs(x - y); y = abs(y - x);", 4),
    bench("roundings", "x = floor(x + y); y = fract(y + x);", 4),
    bench("steps", "x += step(y, x); y += step(x, z);", 4),
    bench("choices", "x.x = x.x > y.x ? x.y : y.y; x.y = x.y > y.y ? x.z : y.x; y.x = x.z > x.x ? y.z : x.x;", 3),
    bench("integers", "i ^= j; j += i; i = i << 1u; j = j >> 2u;", 4),
    bench("integer products", "i *= j; j *= i;", 4),
    bench("integer quotients", "i = j / (i | 1u); j = i % (j | 3u);", 1),
    bench("conversions", "x = vec4(ivec4(x)) + y; y = vec4(uvec4(y)) + x;", 2),
    bench("vectors", "x.x = dot(x, y); y.x = length(y - x); x.yzw = normalize(x.xyz);", 2),
    bench("branches", "if (x.x > y.y) { x.x += z.x * y.y; y.y -= x.z; }", 3),
    bench("arrays", "x.x = a[int(x.y) & 15]; y.x = a[int(y.y) & 15];", 2),
    bench("array stores", "a[int(x.y) & 15] = x.x; x.x = a[int(y.y) & 15];", 2),
    bench("loops", "for (int k = 0; k < m; k++) { x.x = x.x * y.x + z.x; }", 1),
    bench("longer loops", "for (int k = 0; k < m; k++) { x = x * y + z; y = y - x; }", 1),
    bench("derivatives", "x += dFdx(x); y += dFdy(y);", 2),
    texture("nearest", TexelFormat::Rgba8, Filter::Nearest),
    texture("linear", TexelFormat::Rgba8, Filter::Linear),
    texture("mipmap", TexelFormat::Rgba8, Filter::Mipmap),
    texture("nearest floats", TexelFormat::Rgba32f, Filter::Nearest),
    texture("linear floats", TexelFormat::Rgba32f, Filter::Linear),
    texture("mipmap floats", TexelFormat::Rgba32f, Filter::Mipmap),
    Bench {
        name: "fetches",
        body: "x += texelFetch(iChannel0, ivec2(x.xy) & 15, 0); y += texelFetch(iChannel0, ivec2(y.xy) & 15, 0);",
        times: 1,
        rounds: 16,
        channel: Some((TexelFormat::Rgba32f, Filter::Nearest)),
    },
];

/// Three programs of which the second runs a block that the third jumps over, if the device does. They show nothing of
/// single operations.
pub(super) const MASKS: [Bench; 3] = [
    bench("nothing", "", 0),
    bench("taken", "if (p.x > never) { x = sin(x); y = cos(y); }", 2),
    bench("not taken", "if (p.x < never) { x = sin(x); y = cos(y); }", 2),
];

/// Three programs in which no pixel, all pixels, and one of 8 by 8 pixels run a loop.
pub(super) const GROUPS: [Bench; 3] = [
    bench("none", "for (int k = 0; p.x < never && k < m; k++) { x = sin(x) + z; }", 1),
    bench("all", "for (int k = 0; p.x > never && k < m; k++) { x = sin(x) + z; }", 1),
    bench("one", "for (int k = 0; mod(p.x, 8.0) + mod(p.y, 8.0) < 1.5 && k < m; k++) { x = sin(x) + z; }", 1),
];

impl Bench {
    /// Returns the text of Image. No compiler knows `iMouse`, which is 0.
    pub(super) fn text(&self) -> String {
        let body = vec![self.body; self.times].join(" ");
        let array =
            if body.contains("a[") { "float a[16]; for (int q = 0; q < 16; q++) a[q] = float(q) + p.x;" } else { "" };
        format!(
            "void mainImage(out vec4 o, in vec2 p) {{
    float never = -1.0 - iMouse.z;
    int n = {} + int(iMouse.z), m = 12 + int(iMouse.z);
    vec2 u = p / iResolution.xy;
    vec4 x = vec4(p.xyx, 1.0) * 0.001 + 1.1, y = vec4(p.yxy, 2.0) * 0.002 + 1.2, z = vec4(1.5, 1.25, p) * 0.5;
    uvec4 i = uvec4(p.xyx, 7), j = uvec4(p.yxx, 9);
    {array}
    for (int t = 0; t < n; t++) {{ {body} }}
    o = x + y + vec4(i + j);
}}
",
            self.rounds
        )
    }
}
