#define BILINEAR 0
#define MACCORMACK 1
#define CLAMPED 2
#define BFECC 3
#define CUBIC 4
#ifndef METHOD
#define METHOD BILINEAR
#endif
// Radians a step.
#iUniform float turn = 0.02 in { 0.0, 1.0 }

// Where a texel's content was a step before: the exact path, so that only the interpolation errs.
vec2 origin(vec2 p, float angle) {
    vec2 d = p - 0.5 * iResolution.xy;
    float c = cos(angle), s = sin(angle);
    return 0.5 * iResolution.xy + vec2(c * d.x + s * d.y, c * d.y - s * d.x);
}

vec2 at(sampler2D field, ivec2 p) {
    return texelFetch(field, clamp(p, ivec2(0), textureSize(field, 0) - 1), 0).xy;
}

// Between texel centres in full precision, which a sampler does not have.
vec2 bilinear(sampler2D field, vec2 p) {
    vec2 base = floor(p - 0.5), t = p - 0.5 - base;
    ivec2 i = ivec2(base);
    vec2 low = mix(at(field, i), at(field, i + ivec2(1, 0)), t.x);
    vec2 high = mix(at(field, i + ivec2(0, 1)), at(field, i + ivec2(1, 1)), t.x);
    return mix(low, high, t.y);
}

vec4 catmullRom(float t) {
    float t2 = t * t, t3 = t2 * t;
    return 0.5 * vec4(2.0 * t2 - t3 - t, 3.0 * t3 - 5.0 * t2 + 2.0, 4.0 * t2 - 3.0 * t3 + t, t3 - t2);
}

vec2 cubic(sampler2D field, vec2 p) {
    vec2 base = floor(p - 0.5), t = p - 0.5 - base, sum = vec2(0.0);
    vec4 x = catmullRom(t.x), y = catmullRom(t.y);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            sum += x[i] * y[j] * at(field, ivec2(base) + ivec2(i, j) - 1);
        }
    }
    return sum;
}

// Standard deviation .05 of the width, .25 from the centre.
float gaussian(vec2 p) {
    vec2 d = (p / iResolution.xy - vec2(0.5, 0.75)) / 0.05;
    return exp(-0.5 * dot(d, d));
}

// A disk of radius .15 with a slot .05 wide up to .25 above its bottom (Zalesak 1979): the mean of 4 x 4 places in a
// texel, for a slot is a few texels wide and seldom a whole number of them.
float zalesak(vec2 p) {
    float inside = 0.0;
    for (int i = 0; i < 16; ++i) {
        vec2 at = p + 0.25 * vec2(i % 4, i / 4) - 0.375;
        vec2 d = at / iResolution.xy - vec2(0.5, 0.75);
        bool slot = abs(d.x) < 0.025 && d.y < 0.1;
        if (dot(d, d) < 0.0225 && !slot) inside += 1.0;
    }
    return inside / 16.0;
}
