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
