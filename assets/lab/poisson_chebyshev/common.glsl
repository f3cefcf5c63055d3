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

// Least and largest eigenvalue of -lap on the torus, without the constant wave: 4 sin^2(pi / N), and 8 of the checkerboard.
vec2 spectrum() {
    float slowest = sin(3.14159265 / max(iResolution.x, iResolution.y));
    return vec2(4.0 * slowest * slowest, 8.0);
}

// T_k(s) / T_(k + 1)(s) of Chebyshev's polynomials, where s = cosh(a): cosh(k a) / cosh((k + 1) a).
float ratio(float k, float a) {
    return exp(-a) * (1.0 + exp(-2.0 * k * a)) / (1.0 + exp(-2.0 * (k + 1.0) * a));
}
