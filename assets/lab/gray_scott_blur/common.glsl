#include "gray_scott.glsl"
#include "reacted.glsl"

// Weight of a texel i away in a kernel of variance s for each of the two: a Gaussian, sampled; where that is too narrow to be
// sampled, the five weights of sum 1 whose second and fourth moments are the Gaussian's.
vec2 weight(int i, vec2 s) {
    vec2 wide = exp(-0.5 * float(i * i) / s);
    vec2 beside = (4.0 * s - 3.0 * s * s) / 6.0, beyond = (3.0 * s * s - s) / 24.0;
    vec2 narrow = i == 0 ? 1.0 - 2.0 * (beside + beyond) : i == 1 ? beside : i == 2 ? beyond : vec2(0.0);
    return mix(wide, narrow, vec2(lessThan(s, vec2(0.9))));
}

// Sums along `along` with kernels of variance 2 D dt, which is the solution for a step.
vec2 blurred(sampler2D field, ivec2 p, ivec2 along, bool reacts) {
    ivec2 size = ivec2(iResolution.xy);
    vec2 variance = 2.0 * DIFFUSION * dt, w = texelFetch(field, p, 0).xy;
    vec2 weights = weight(0, variance), here = reacts ? reacted(w) : w, sum = vec2(0.0);
    int radius = variance.x < 0.9 ? 2 : int(ceil(5.0 * sqrt(variance.x)));
    for (int i = 1; i <= radius; ++i) {
        vec2 a = texelFetch(field, (p + i * along) % size, 0).xy, b = texelFetch(field, (p - i * along + size) % size, 0).xy;
        vec2 each = weight(i, variance);
        sum += each * (reacts ? (reacted(a) - here) + (reacted(b) - here) : (a - here) + (b - here));
        weights += 2.0 * each;
    }
    return here + sum / weights;
}
