// Best is 2 / (1 + sqrt(1 - r^2)), where r = cos^2(pi / N) is the factor of Jacobi's iteration for the slowest wave of a torus.
#iUniform float relaxation = 1.9 in { 1.0, 2.0 }
// A texel is (p, f): lap p = f with h = 1, on a torus.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(field, (p + size) % size, 0).xy;
}

// The p that the equation asks for here, given those beside.
float solved(sampler2D field, ivec2 p, float f) {
    float sum = at(field, p + ivec2(1, 0)).x + at(field, p - ivec2(1, 0)).x + at(field, p + ivec2(0, 1)).x
        + at(field, p - ivec2(0, 1)).x;
    return 0.25 * (sum - f);
}
