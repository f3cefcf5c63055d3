// Paper lanterns on a string over dark water, in linear light: their paper is some times as bright as a white page, their
// flames far more, and nothing here glows. What glow the picture has is the bloom's.

#iUniform float flame = 6.0 in { 0.0, 40.0 }       // radiance of the paper before a flame
#iUniform float constant = 0.0 in { 0.0, 4.0 }     // above 0: a wall of just this light, which bloom must leave alone

const int LANTERNS = 6;
const float WATER = -0.16; // height of its surface

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

// Where the string hangs.
float stringHeight(float x) {
    return 0.30 + 0.16 * x * x;
}

// A lantern's middle (xy) and half width (z). Each swings a little, in its own time.
vec3 lantern(int i, float time) {
    float f = float(i);
    float x = -0.75 + 0.30 * f + 0.03 * hash(ivec2(i, 3));
    float size = 0.050 + 0.018 * hash(ivec2(i, 5));
    float swing = 0.12 * sin(1.3 * time + 2.4 * f);
    return vec3(x + 0.10 * swing, stringHeight(x) - 0.07 - 1.3 * size, size);
}

vec3 paper(int i) {
    return i % 3 == 0 ? vec3(1.00, 0.16, 0.06) : i % 3 == 1 ? vec3(1.00, 0.52, 0.14) : vec3(1.00, 0.30, 0.36);
}

// What stands over the water, seen along a straight line.
vec3 overWater(vec2 p, float pixel, float time) {
    vec3 light = mix(vec3(0.012, 0.016, 0.040), vec3(0.004, 0.005, 0.016), smoothstep(WATER, 0.5, p.y));
    // Hills, and the houses' windows in them.
    float hill = WATER + 0.06 + 0.035 * sin(3.1 * p.x + 1.0) + 0.020 * sin(7.3 * p.x);
    float inHill = clamp((hill - p.y) / pixel + 0.5, 0.0, 1.0);
    light = mix(light, vec3(0.003, 0.004, 0.008), inHill);
    vec2 house = floor(p * vec2(34.0, 60.0));
    vec2 inHouse = abs(fract(p * vec2(34.0, 60.0)) - 0.5);
    float lit = step(0.93, hash(ivec2(house))) * step(max(inHouse.x, inHouse.y), 0.22) * step(house.y / 60.0 + 0.02, hill);
    light += lit * inHill * vec3(1.0, 0.62, 0.25) * 1.2;
    // The string.
    float string = clamp((0.0012 - abs(p.y - stringHeight(p.x))) / pixel + 0.5, 0.0, 1.0);
    light = mix(light, vec3(0.02), string);
    for (int i = 0; i < LANTERNS; i++) {
        vec3 at = lantern(i, time);
        vec2 q = (p - at.xy) / at.z;
        // A barrel: narrower above and below, with ribs around it.
        float width = 1.0 - 0.32 * q.y * q.y * 0.6;
        float far = max(abs(q.x) - width, abs(q.y) - 1.25) * at.z;
        float inside = clamp(-far / pixel + 0.5, 0.0, 1.0);
        float flicker = 1.0 + 0.10 * sin(11.0 * time + 5.0 * float(i)) * sin(7.3 * time + float(i));
        float near = exp(-1.6 * dot(q - vec2(0.0, -0.35), q - vec2(0.0, -0.35)));
        float rib = 0.80 + 0.20 * cos(25.0 * q.y);
        vec3 glow = paper(i) * flame * flicker * rib * (0.25 + near) + vec3(1.0, 0.75, 0.40) * flame * 0.9 * near * near;
        light = mix(light, glow, inside);
        // Its caps and the thread it hangs from.
        float cap = max(abs(q.x) - 0.55, abs(abs(q.y) - 1.30) - 0.10) * at.z;
        light = mix(light, vec3(0.010, 0.006, 0.004), clamp(-cap / pixel + 0.5, 0.0, 1.0));
        float thread = max(abs(p.x - at.x) - 0.0008, max(at.y + 1.3 * at.z - p.y, p.y - stringHeight(p.x)));
        light = mix(light, vec3(0.02), clamp(-thread / pixel + 0.5, 0.0, 1.0));
    }
    return light;
}

// Radiance at p; y runs from -0.5 to 0.5, `pixel` is the size of one.
vec3 scene(vec2 p, float pixel, float time) {
    if (constant > 0.0) return vec3(1.0, 0.6, 0.25) * constant;
    if (p.y >= WATER) return overWater(p, pixel, time);
    // Ripples turn the reflected line up and down, the more the nearer the water is.
    float depth = WATER - p.y;
    float near = 0.15 + depth;
    float ripple = sin(8.0 * p.x + 26.0 / near + 1.7 * time) + 0.6 * sin(-13.0 * p.x + 41.0 / near + 2.3 * time);
    vec2 mirrored = vec2(p.x + 0.010 * ripple * near, WATER + depth + 0.045 * ripple * near);
    float part = mix(0.55, 0.18, smoothstep(0.0, 0.34, depth));
    return overWater(mirrored, pixel + 0.02 * near, time) * part + vec3(0.002, 0.003, 0.007);
}
