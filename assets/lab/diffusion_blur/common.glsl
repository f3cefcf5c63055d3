// D dt / h^2
#iUniform float rate = 2.0 in { 0.0, 64.0 }
#include "spot.glsl"

// Sum of the texels along `along` with the weights of a Gaussian of variance 2 D dt, which is the exact solution for a step.
float blurred(sampler2D field, ivec2 p, ivec2 along) {
    ivec2 size = ivec2(iResolution.xy);
    float variance = 2.0 * rate, here = texelFetch(field, p, 0).x, sum = 0.0, weights = 1.0;
    int radius = min(int(ceil(5.0 * sqrt(variance))), size.x / 2);
    for (int i = 1; i <= radius; ++i) {
        float weight = exp(-0.5 * float(i * i) / variance);
        float pair = (texelFetch(field, (p + i * along) % size, 0).x - here)
            + (texelFetch(field, (p - i * along + size) % size, 0).x - here);
        sum += weight * pair;
        weights += 2.0 * weight;
    }
    return here + sum / weights;
}
