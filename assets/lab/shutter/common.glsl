#ifndef METHOD
#define METHOD MIDDLE
#endif
// Moments while the shutter is open.
#ifndef PARTS
#define PARTS 8
#endif
#define OPENING 0
#define MIDDLE 1
#define JITTER 2

// Four pictures of side h, in pixels from the bottom left, at a time from 0 to 1.
float scene(vec2 p, float h, float t) {
    vec2 q = p - h * step(h, p);
    if (p.x < h && p.y < h) return float(distance(q, mix(vec2(0.25, 0.4), vec2(0.75, 0.6), t) * h) < 0.1 * h);
    if (p.y < h) {
        float angle = 0.3 + 0.7 * t;
        vec2 d = q - 0.5 * h, axis = vec2(cos(angle), sin(angle));
        bool is = dot(d, d) < 0.1764 * h * h && abs(dot(d, vec2(-axis.y, axis.x))) < 0.02 * h && dot(d, axis) > 0.0;
        return float(is);
    }
    if (p.x < h) {
        vec2 d = (q / h - mix(vec2(0.25, 0.4), vec2(0.75, 0.6), t)) / 0.08;
        return exp(-0.5 * dot(d, d));
    }
    return float(distance(q, mix(vec2(0.15, 0.3), vec2(0.85, 0.7), t) * h) < 1.5);
}

#include "pcg.glsl"
