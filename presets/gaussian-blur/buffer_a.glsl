// The card that is blurred: fine things at every angle, hard edges, no anti-aliasing, and below it one lit texel.

// A number in 0..1 for a cell, of integers alone and so the same on every GPU: pcg2d (M. Jarzynski, M. Olano, "Hash
// Functions for GPU Rendering", JCGT 9(3), 2020).
float hash(ivec2 cell) {
    uvec2 v = uvec2(cell) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return float(v.x >> 8u) / 16777216.0;
}

mat2 turned(float angle) {
    return mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
}

// p is 0 in the middle and 1 at the rim.
vec3 card(vec2 p) {
    float r = length(p), a = atan(p.y, p.x);
    if (r > 1.0) return vec3(0.0);
    float time = turning * iTime;
    if (r > 0.93) return vec3(0.85, 0.80, 0.70);
    if (r > 0.60) { // a ring of sparks, each of its own colour
        float sector = (a + 0.15 * time) / 6.2832 * 24.0, id = mod(floor(sector), 24.0);
        vec2 local = vec2((fract(sector) - 0.5) * 6.2832 / 24.0 * r, r - 0.765);
        vec3 own = 0.5 + 0.5 * cos(6.2832 * (id / 24.0 + vec3(0.0, 0.33, 0.67)));
        float size = 0.02 + 0.07 * hash(ivec2(id, 3));
        return length(local) < size ? 1.6 * own : vec3(0.012, 0.015, 0.03);
    }
    if (r > 0.55) return vec3(0.85, 0.80, 0.70);
    if (p.y > 0.0 == p.x > 0.0) { // a star of rays that no grid resolves in the middle
        vec2 q = turned(0.2 * time) * p;
        return fract(atan(q.y, q.x) / 6.2832 * 36.0) < 0.5 ? vec3(0.95, 0.93, 0.88) : vec3(0.02, 0.02, 0.05);
    }
    vec2 q = turned(-0.1 * time) * p * 13.0; // hairlines and a chequer of two inks
    if (min(abs(fract(q.x) - 0.5), abs(fract(q.y) - 0.5)) < 0.06) return vec3(1.3, 1.1, 0.6);
    return mod(floor(q.x + 0.5) + floor(q.y + 0.5), 2.0) < 1.0 ? vec3(0.65, 0.06, 0.10) : vec3(0.03, 0.13, 0.35);
}

void mainImage(out vec4 light, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), size = ivec2(iResolution.xy);
    ivec3 panel = panelOf(p.x, size.x);
    vec2 centre = vec2(float(panel.x) + 0.5 * float(panel.y), 0.62 * iResolution.y);
    float radius = 0.94 * min(0.5 * float(panel.y), 0.36 * iResolution.y);
    light = vec4(card((fragCoord - centre) / max(radius, 1.0)), 1.0);
    if (p == impulseOf(panel, size.y)) light = vec4(1.0);
}
