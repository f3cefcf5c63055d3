// A step of Euler's for what carries itself: -(u grad) u, by upwind differences of fifth order where the flow is
// smooth. G.-S. Jiang, D. Peng, "Weighted ENO schemes for Hamilton-Jacobi equations", SIAM Journal on Scientific
// Computing 21 (6), 2000.

// The derivative of both components, in five differences from upwind to downwind.
vec2 weno(vec2 a, vec2 b, vec2 c, vec2 d, vec2 e) {
    // Three parabolas, how rough each is, and weights that are .1, .6 and .3 where all are smooth.
    vec2 left = (2.0 * a - 7.0 * b + 11.0 * c) / 6.0, middle = (5.0 * c - b + 2.0 * d) / 6.0;
    vec2 right = (2.0 * c + 5.0 * d - e) / 6.0;
    vec2 p = a - 2.0 * b + c, q = b - 2.0 * c + d, r = c - 2.0 * d + e;
    vec2 s = a - 4.0 * b + 3.0 * c, t = b - d, w = 3.0 * c - 4.0 * d + e;
    vec2 largest = max(max(max(a * a, b * b), max(c * c, d * d)), e * e);
    vec2 epsilon = 1e-6 * largest + 1e-30;
    vec2 x = 13.0 / 12.0 * p * p + 0.25 * s * s + epsilon, y = 13.0 / 12.0 * q * q + 0.25 * t * t + epsilon;
    vec2 z = 13.0 / 12.0 * r * r + 0.25 * w * w + epsilon;
    // Weights by 1 / x^2, times the least squared: the squares of small slopes are below what 32 bits hold.
    vec2 least = min(x, min(y, z));
    vec2 i = 0.1 * (least / x) * (least / x), j = 0.6 * (least / y) * (least / y), k = 0.3 * (least / z) * (least / z);
    return (i * left + j * middle + k * right) / (i + j + k);
}

// Along one axis: from where the flow comes.
vec2 slope(sampler2D field, ivec2 p, ivec2 direction, float speed) {
    ivec2 d = speed > 0.0 ? direction : -direction;
    vec2 u[6];
    for (int i = 0; i < 6; ++i) u[i] = at(field, p + (i - 3) * d);
    vec2 along = weno(u[1] - u[0], u[2] - u[1], u[3] - u[2], u[4] - u[3], u[5] - u[4]);
    return speed > 0.0 ? along : -along;
}

vec2 stepped(sampler2D field, ivec2 p) {
    vec2 u = at(field, p);
    return u - dt * (u.x * slope(field, p, ivec2(1, 0), u.x) + u.y * slope(field, p, ivec2(0, 1), u.y));
}
