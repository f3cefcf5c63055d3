// Gray-Scott: U is fed everywhere, V eats it and multiplies (U + 2V -> 3V), and V dies.
//
//     du/dt = Du lap u - u v^2 + feed (1 - u)
//     dv/dt = Dv lap v + u v^2 - (feed + kill) v
//
// P. Gray, S. Scott, "Autocatalytic reactions in the isothermal, continuous stirred tank reactor", Chem. Eng. Sci. 39,
// 1984; the map of patterns: J. Pearson, "Complex Patterns in a Simple System", Science 261, 1993. Diffusion rates are
// Pearson's (2e-5 and 1e-5 on a square of 2.5 with 256 cells) in cells: a spot is some 14 pixels wide on every canvas.
//
// A texel is (1 - u, v). The fed state is all zeros: frame 0 and what a resize uncovers need no initialisation, and
// small departures from it keep all their digits.

#iUniform float feed = 0.0335 in { 0.0, 0.1 }
#iUniform float kill = 0.0595 in { 0.0, 0.075 }

// 1: all patterns at once. Feed runs upwards from 0.010 to 0.075; kill runs across the band that has patterns, on both
// sides of the fold kill = sqrt(feed) / 2 - feed where the second constant state begins, so that no part of the picture
// lies empty.
#iUniform float map = 0.0 in { 0.0, 1.0 } step 1.0
// How far feed and kill sway across the picture: patterns that differ from place to place live side by side.
#iUniform float sway = 0.6 in { 0.0, 2.0 }

// How diffusion is done. 0: five-point Laplacian. 1: nine-point (Mehrstellen), as accurate but round: at wavelengths of
// 8 cells its rate varies with direction by 0.05 % instead of 2.5 %. 2: a blur, the binomial kernel of the same
// variance. 3: the same as two passes, rows and then columns, of a Gaussian: as exact as a grid allows and stable at
// any step, which may so be four times as long; then the reaction, in steps of its own.
#iUniform int diffusion = 1 in { 0, 3 }

// Time of a step. For diffusion alone explicit Euler is stable to dt = 1 / (4 Du) = 1.19 with five points and 3 / (8 Du)
// = 1.79 with nine; the reaction needs room beside it. Beyond 1 with five points, and 1.19 with nine or with the blur
// in one pass, the step stays there and Image hatches the foot of the picture. With 3 the limit is 5, where the
// kernel's tails reach the end of its 15 taps. Eight steps are made a frame: patterns grow by frames, and by pixels, while
// the sower wanders by the second.
#iUniform float dt = 1.0 in { 0.0, 10.0 }

#iUniform float brush_size = 0.035 in { 0.005, 0.2 }
#iUniform float sower = 1.0 in { 0.0, 1.0 }
#iUniform color3 glaze = color3(0.05, 0.30, 0.36)
#iUniform color3 clay = color3(0.97, 0.86, 0.72)

const vec2 RATE = vec2(0.2097152, 0.1048576); // Du, Dv in cells^2 a unit of time
const float LONGEST_FIVE_POINTS = 1.0, LONGEST_STEP = 1.19, LONGEST_BLUR = 5.0;

float longestStep() {
    return diffusion == 3 ? LONGEST_BLUR : diffusion == 0 ? LONGEST_FIVE_POINTS : LONGEST_STEP;
}

// The discrete Gaussian of variance t, which is to a grid what the Gaussian is to the plane: exp(-t) I_n(t), of the sum
// 1 and just that variance (T. Lindeberg, "Scale-Space for Discrete Signals", PAMI 12, 1990). For U and V, of variance
// 2 D h each. I_(n-1) = I_(n+1) + 2 n / t I_n, begun far out with any number and divided by the sum (J. Miller 1952).
const int TAPS = 7;

void gaussian(float h, out vec2 weight[TAPS + 1]) {
    vec2 t = max(2.0 * RATE * h, 1e-3), outer = vec2(0.0), here = vec2(1e-30), sum = vec2(0.0);
    for (int n = TAPS + 2; n > 0; n--) {
        if (n <= TAPS) weight[n] = here;
        if (n <= TAPS) sum += 2.0 * here;
        vec2 inner = outer + 2.0 * float(n) / t * here;
        outer = here;
        here = inner;
    }
    sum += here;
    for (int n = 1; n <= TAPS; n++) weight[n] /= sum;
    weight[0] = here / sum;
}

// (feed, kill) at a place, uv in 0..1.
vec2 recipe(vec2 uv) {
    vec2 waves = vec2(sin(5.1 * uv.x + 1.3) * sin(4.3 * uv.y + 0.4), sin(3.7 * uv.x - 2.9 * uv.y + 0.9));
    vec2 here = vec2(feed, kill) + sway * vec2(0.012, 0.0022) * waves;
    float f = mix(0.010, 0.075, uv.y), fold = 0.5 * sqrt(f) - f;
    vec2 band = vec2(-0.0018 * smoothstep(0.008, 0.035, f) * (1.0 - 0.6 * uv.y), mix(0.0065, 0.0006, uv.y));
    return max(mix(here, vec2(f, fold + mix(band.x, band.y, uv.x)), map), 0.0);
}

// How far p is from the segment a-b.
float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-6), 0.0, 1.0));
}

// While nobody draws, a sower wanders over the picture.
vec2 sowerAt(float time, vec2 resolution) {
    return resolution * (0.5 + 0.43 * vec2(sin(0.71 * time + 0.6), sin(0.93 * time + 0.2 * sin(0.31 * time))));
}

// Three numbers in 0..1 for a square: T. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020
// (their pcg3d).
vec3 hash(ivec2 square) {
    uvec3 v = uvec3(ivec3(square, 7)) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}
