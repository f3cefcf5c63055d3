#include "gray_scott.glsl"
#include "turn.glsl"

// The functions by which exponential integrators weigh what acts for a step: the means of e^((1 - s) z) and of s e^((1 - s) z) over s
// from 0 to 1. Near 0 by their series, where the closed forms cancel.
vec2 phi1(vec2 z) {
    vec2 near = 1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 6.0))));
    return mix((exp(z) - 1.0) / min(z, -0.1), near, vec2(greaterThan(z, vec2(-0.5))));
}

vec2 phi2(vec2 z) {
    vec2 near = 0.5 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 6.0 * (1.0 + z / 7.0)))));
    vec2 far = min(z, -0.1);
    return mix((exp(z) - 1.0 - z) / (far * far), near, vec2(greaterThan(z, vec2(-0.5))));
}
