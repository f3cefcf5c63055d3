// D dt / h^2
#iUniform float rate = 2.0 in { 0.0, 64.0 }
// Amplitude of a checkerboard on top of the spot: what an unstable scheme amplifies first.
#iUniform float noise = 0.0 in { 0.0, 1.0 }

float checker(vec2 p) {
    return 1.0 - 2.0 * mod(floor(p.x) + floor(p.y), 2.0);
}

// A Gaussian of standard deviation 1/32 of the width, and its images on the torus.
float spot(vec2 p) {
    float s = iResolution.x / 32.0, sum = 0.0;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            vec2 d = p - iResolution.xy * (0.5 + vec2(i, j));
            sum += exp(-0.5 * dot(d, d) / (s * s));
        }
    }
    return sum;
}

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
