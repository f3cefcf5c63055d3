#include "solved.glsl"

// Least and largest eigenvalue of -lap on the torus, without the constant wave: 4 sin^2(pi / N), and 8 of the checkerboard.
vec2 spectrum() {
    float slowest = sin(3.14159265 / max(iResolution.x, iResolution.y));
    return vec2(4.0 * slowest * slowest, 8.0);
}

// T_k(s) / T_(k + 1)(s) of Chebyshev's polynomials, where s = cosh(a): cosh(k a) / cosh((k + 1) a).
float ratio(float k, float a) {
    return exp(-a) * (1.0 + exp(-2.0 * k * a)) / (1.0 + exp(-2.0 * (k + 1.0) * a));
}
