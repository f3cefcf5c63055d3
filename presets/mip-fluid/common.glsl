// A fluid on a torus whose far-reaching terms are sums over mip levels: level l of a buffer is the mean over squares
// 2^l wide.
//
//     moved     the velocity carried along (semi-Lagrangian: J. Stam, "Stable Fluids", SIGGRAPH 1999), plus turbulence
//     and
//               confinement on every scale, plus the stirring
//     measure   vorticity, summed over the levels of `moved`, and divergence
//     pressure  an estimate of the solution of lap p = div u, by one sum over the levels of `measure`
//     velocity  moved - grad p
//
// Pressure: a wave of length about 4 * 2^l is what levels l and l + 1 differ by, and 1 / k^2 of it is about 4^l. Summed
// by parts that gives level l the weight 4^l - 4^(l-1) = 3/4 4^l: `pressure_slope` is the 4. One sum is no solver: of
// waves longer than 32 texels it leaves 0.18 a frame, of those of 8 texels 0.3, of those of 4 a half, and of the
// shortest everything, whatever one does; enough to look at, not to measure by (see fluid-accurate for that). The first
// to sum a Poisson problem's scales in one pass over mip maps were pyramid methods: P. Burt, "Fast Filter Transforms
// for Image Processing", CGIP 16, 1981; R. Fattal, "Convolution Pyramids", SIGGRAPH Asia 2011.
//
// No step is too long: advection invents nothing and MAX_SPEED ends what turbulence and confinement feed. But what is
// carried is bilinear: waves of 64 texels, left to themselves, keep 0.76 of their energy over two seconds, and 0.11 at
// ten times the step (the slider `speed`).
//
// Units: canvas heights and seconds.

// How many levels are summed. The canvas has log2 of its size; more change nothing.
#iUniform int scales = 8 in { 0, 12 }
// The weight of level l in turbulence and confinement. 0: falloff^l. 1: a bump, exp(-((l - favourite) / 1.5)^2).
#iUniform int weight_function = 0 in { 0, 1 }
#iUniform float falloff = 0.75 in { 0.25, 1.5 }
#iUniform float favourite = 3.0 in { 0.0, 8.0 }
#iUniform float turbulence = 0.5 in { 0.0, 2.0 }
#iUniform float confinement = 0.6 in { 0.0, 3.0 }
// With a slope of 4 and a strength above 0.64 the sum takes more than twice the divergence of some waves, and they
// grow; with more than 4 the longest waves get more weight the larger the canvas is. (By power iteration on 320 x 192.)
#iUniform float pressure_slope = 4.0 in { 1.0, 4.0 }
#iUniform float pressure_strength = 0.5 in { 0.0, 0.6 }
// Time against the clock's.
#iUniform float speed = 1.0 in { 0.0, 10.0 }
// Velocity falls to 1/e in so many seconds.
#iUniform float drag_seconds = 6.0 in { 0.1, 60.0 }
#iUniform float stirring = 1.0 in { 0.0, 1.0 }
#iUniform float repaint_seconds = 5.0 in { 0.5, 120.0 }
#iUniform float brush_size = 0.06 in { 0.01, 0.3 }

const int MAX_SCALES = 12;
const float MAX_SPEED = 2.0; // heights a second; only a violent hand gets there

float weightOf(int level) {
    float l = float(level);
    float off = (l - favourite) / 1.5;
    return weight_function == 0 ? pow(falloff, l) : exp(-off * off);
}

// Levels that there are, and are asked for.
int levelsOf(vec2 size) {
    return min(scales, int(log2(max(max(size.x, size.y), 1.0))) + 1);
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

vec2 perp(vec2 v) {
    return vec2(-v.y, v.x);
}

float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-9), 0.0, 1.0));
}

// The shorter way round from one place on the torus to another.
vec2 wayRound(vec2 d, vec2 size) {
    return d - size * round(d / size);
}
