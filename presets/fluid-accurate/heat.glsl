// Viscosity along one direction: u_t = nu u_xx on the grid, solved exactly and not in steps. What is in one face has
// after a time t gone to the n-th face from it by e^(-2a) I_n(2a), where a = nu t in cells squared and I_n are Bessel
// functions. All weights are positive and their sum is 1, so that no viscosity is too much. They come from the far end
// inwards by J. C. P. Miller's recurrence, I_(n-1) = I_(n+1) + (2 n / x) I_n (M. Abramowitz, I. Stegun, "Handbook of
// Mathematical Functions", 9.12), and their sum as found makes them whole. Both directions one after the other are the
// heat equation in the plane.
//
// The weights multiply differences from the face in the middle. Summed as they are, they make 1 only up to rounding,
// which is to the same side in every frame: a uniform wind gained
// 0.00003 of itself in 1,000 frames on 256 rows.
#include "staggered.glsl"

vec2 facesOf(sampler2D field, ivec2 p) {
    return vec2(faceOf(field, p, 0), faceOf(field, p, 1));
}

// `amount` is a.
vec2 spreadAlong(sampler2D field, ivec2 p, ivec2 direction, float amount) {
    vec2 centre = texelFetch(field, p, 0).xy;
    if (amount < 1e-7) return centre;
    // Five standard deviations, and some for a so small that the weights are no Gaussian.
    int reach = int(ceil(5.0 * sqrt(2.0 * amount))) + 3;
    float further = 0.0, weight = 1e-30, total = 0.0;
    vec2 sum = vec2(0.0);
    for (int n = reach; n > 0; n--) {
        sum += weight * ((facesOf(field, p - n * direction) - centre) + (facesOf(field, p + n * direction) - centre));
        total += 2.0 * weight;
        float nearer = further + float(n) / amount * weight;
        further = weight;
        weight = nearer;
    }
    vec2 spread = centre + sum / (total + weight);
    if (walls != PERIODIC) spread *= vec2(greaterThan(p, ivec2(0))); // the walls' own faces
    return spread;
}
