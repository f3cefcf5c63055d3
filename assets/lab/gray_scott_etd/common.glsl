#iUniform float feed = 0.0545 in { 0.0, 0.1 }
#iUniform float kill = 0.062 in { 0.0, 0.1 }
#iUniform float dt = 1.0 in { 0.0, 16.0 }
// Of u and v, in texels^2 for a unit of time.
const vec2 DIFFUSION = vec2(0.16, 0.08);

vec2 reaction(vec2 w) {
    float rate = w.x * w.y * w.y;
    return vec2(feed * (1.0 - w.x) - rate, rate - (feed + kill) * w.y);
}

// Smooth spots of v in a sea of u = 1: three, so that nothing of the pattern is a symmetry.
vec4 seeded(vec2 p) {
    float v = 0.0;
    vec2 spots[3] = vec2[](vec2(0.3, 0.35), vec2(0.62, 0.44), vec2(0.45, 0.7));
    for (int i = 0; i < 3; ++i) {
        vec2 d = (p - spots[i] * iResolution.xy) / (4.0 + float(i));
        v += 0.5 * exp(-0.5 * dot(d, d));
    }
    return vec4(1.0 - v, 0.5 * v, 0.0, 1.0);
}

// (cos, sin) of m / n of a turn, within the last bits of a float on every device: the angle is brought within an eighth of
// a turn, where their series are short. What devices give by themselves may be 5e-4 off.
vec2 turn(int m, int n) {
    int quarter = (8 * m + n) / (2 * n);
    float a = 1.57079632679 * float(4 * m - quarter * n) / float(n), b = a * a;
    float s = a * (1.0 - b / 6.0 * (1.0 - b / 20.0 * (1.0 - b / 42.0 * (1.0 - b / 72.0))));
    float c = 1.0 - b / 2.0 * (1.0 - b / 12.0 * (1.0 - b / 30.0 * (1.0 - b / 56.0 * (1.0 - b / 90.0))));
    vec2 w = (quarter & 1) == 0 ? vec2(c, s) : vec2(-s, c);
    return (quarter & 2) == 0 ? w : -w;
}

vec2 times(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

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
