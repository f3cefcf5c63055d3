// Neon tubes before a brick wall, in linear light: a tube is some ten times as bright as paper, and nothing here glows.
// What glow the picture has is the bloom's.

#iUniform float neon = 10.0 in { 0.0, 40.0 }       // radiance of a tube
#iUniform float constant = 0.0 in { 0.0, 4.0 }     // above 0: a wall of just this light, which bloom must leave alone

float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0));
}

float triangleDistance(vec2 p, float r) {
    vec2 a = r * vec2(0.0, 1.0), b = r * vec2(-0.866, -0.5), c = r * vec2(0.866, -0.5);
    return min(segmentDistance(p, a, b), min(segmentDistance(p, b, c), segmentDistance(p, c, a)));
}

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

const int TUBES = 4;
const vec3 GAS[TUBES] = vec3[TUBES](vec3(1.00, 0.10, 0.28), vec3(0.08, 0.55, 1.00), vec3(1.00, 0.48, 0.06),
                                    vec3(0.30, 1.00, 0.45));

// How far p is from each tube, and how brightly each burns.
void tubes(vec2 p, float time, out vec4 far, out vec4 burning) {
    vec2 q = p + vec2(0.42, 0.0);
    far.x = abs(length(q) - 0.27);
    far.y = triangleDistance(q + vec2(0.0, 0.02), 0.17);
    vec2 w = p - vec2(0.42, 0.14);
    float y = 0.05 * sin(18.0 * w.x - 3.0 * time), slope = 0.9 * cos(18.0 * w.x - 3.0 * time);
    far.z = length(vec2(max(abs(w.x) - 0.30, 0.0), (w.y - y) / sqrt(1.0 + slope * slope)));
    vec2 lamp = vec2(0.42 + 0.30 * sin(1.1 * time), -0.20 + 0.045 * cos(2.2 * time));
    far.w = length(p - lamp) - 0.006;
    float old = fract(0.23 * time); // the triangle's transformer is not what it was
    burning = vec4(1.0, old > 0.90 ? step(0.4, hash(ivec2(floor(24.0 * time), 1))) : 1.0, 1.0, 1.5);
}

// Radiance at p; y runs from -0.5 to 0.5, `pixel` is the size of one.
vec3 scene(vec2 p, float pixel, float time) {
    if (constant > 0.0) return vec3(1.0, 0.6, 0.25) * constant;
    vec4 far, burning;
    tubes(p, time, far, burning);

    vec2 course = p * vec2(9.0, 20.0);
    course.x += 0.5 * mod(floor(course.y), 2.0);
    vec2 inBrick = abs(fract(course) - 0.5) / vec2(9.0, 20.0);
    vec2 edge = vec2(0.5) / vec2(9.0, 20.0) - inBrick;
    float mortar = 1.0 - smoothstep(0.0015, 0.0025 + pixel, min(edge.x, edge.y));
    vec3 wall = mix(vec3(0.24, 0.10, 0.07) * (0.6 + 0.6 * hash(ivec2(floor(course)))), vec3(0.20, 0.19, 0.18), mortar);
    wall *= 0.85 + 0.3 * hash(ivec2(floor(course * vec2(18.0, 8.0))));

    // The tubes light the wall: each is near a line, whose light falls with the distance; they stand 0.05 before it.
    vec3 light = vec3(0.020, 0.024, 0.040);
    vec3 tube = vec3(0.0);
    for (int i = 0; i < TUBES; i++) {
        vec3 gas = GAS[i] * burning[i];
        light += gas * neon * 0.0075 / (0.05 + 4.0 * far[i] * far[i] + 0.35 * far[i]);
        tube += (gas + 0.12 * burning[i]) * neon * clamp((0.0075 - far[i]) / max(pixel, 1e-5) + 0.5, 0.0, 1.0);
    }
    return wall * light + tube;
}
