// Viscosity along one direction: u_t = nu u_xx, solved exactly in time, so that no viscosity and no step is too much. With
// a = nu t in cells squared, a wave k has e^(-a k^2) left of it. Both directions one after the other are the heat equation
// in the plane.
//
// From a = 2 on the weights are the heat kernel's own, e^(-n^2 / 4a): sampled a cell apart it errs by e^(-a pi^2). Below,
// they begin as the exact solution with second differences, whose Laplacian is s = 4 sin^2(k/2) in place of k^2: what is
// in one face has gone to the n-th from it by w_n = e^(-2a) I_n(2a), I_n being Bessel functions, from the far end inwards
// by J. C. P. Miller's recurrence, I_(n-1) = I_(n+1) + (2 n / x) I_n (M. Abramowitz, I. Stegun, "Handbook of Mathematical
// Functions", 9.12). k^2 is s + s^2 / 12 and a rest of sixth order, so fourth differences of the weights, times -a / 12,
// make them e^(-a s) (1 - a s^2 / 12). That is of fourth order, and never more than 1 in size, as s is at most 4. Next to a
// wall that the flow sticks to it is of second order: the velocity goes on behind it with the other sign, and a fourth
// difference there meets that kink. Divided by their sum as found the weights make 1.
//
// The weights multiply differences from the face in the middle. Summed as they are, they make 1 only up to rounding,
// which is to the same side in every frame: a uniform wind gained
// 0.00003 of itself in 1,000 frames on 256 rows.
#include "staggered.glsl"

vec2 facesOf(sampler2D field, ivec2 p) {
    return vec2(faceOf(field, p, 0), faceOf(field, p, 1));
}

// How far the faces `distance` before and after p are from the one at p, together.
vec2 differenceOf(sampler2D field, ivec2 p, ivec2 distance, vec2 centre) {
    return (facesOf(field, p - distance) - centre) + (facesOf(field, p + distance) - centre);
}

// `amount` is a.
vec2 spreadAlong(sampler2D field, ivec2 p, ivec2 direction, float amount) {
    vec2 centre = texelFetch(field, p, 0).xy;
    if (amount < 1e-7) return centre;
    // Five standard deviations, and some for a so small that the weights are no Gaussian.
    int reach = int(ceil(5.0 * sqrt(2.0 * amount))) + 3;
    float total;
    vec2 sum = vec2(0.0);
    if (amount >= 2.0) {
        // With q = e^(-1 / 4a) the weights are q^(n^2), and each is q^(2n - 1) times the one before.
        float q = exp(-0.25 / amount), ratio = q, weight = 1.0;
        total = 1.0;
        for (int n = 1; n <= reach; n++) {
            weight *= ratio;
            ratio *= q * q;
            sum += weight * differenceOf(field, p, n * direction, centre);
            total += 2.0 * weight;
        }
    } else {
        // w of n + 2, n + 1, n, n - 1 and n - 2.
        float w2 = 0.0, w1 = 0.0, w = 1e-30, v1 = float(reach) / amount * w, v2 = w + float(reach - 1) / amount * v1;
        total = 0.0;
        for (int n = reach; n > 0; n--) {
            float weight = w - amount / 12.0 * (w2 - 4.0 * w1 + 6.0 * w - 4.0 * v1 + v2);
            sum += weight * differenceOf(field, p, n * direction, centre);
            total += 2.0 * weight;
            float nearer = v1 + float(n - 2) / amount * v2;
            w2 = w1;
            w1 = w;
            w = v1;
            v1 = v2;
            v2 = nearer;
        }
        total += w - amount / 12.0 * (2.0 * w2 - 8.0 * w1 + 6.0 * w);
    }
    vec2 spread = centre + sum / total;
    if (walls != PERIODIC) spread *= vec2(greaterThan(p, ivec2(0))); // the walls' own faces
    return spread;
}
