// A thousand particles without a list: number n is texel (n % 32, n / 32) of three buffers' worth of state.
//
//     life      (age, lifetime) in seconds, type, births so far
//     motion    place and velocity, in canvas heights from the middle, and seconds
//     tiles     for each of 16 x 9 parts of the canvas the numbers of the particles that shine there
//     light     what has been seen, fading: a long exposure
//
// Sparks fly on exact paths but for errors of second order: 6e-6 of their way in .8 s at 60 steps a second, 1e-4 at 15.
//
// A fragment shader cannot scatter, so each pixel gathers; the tiles keep it from asking all thousand. (The usual
// reference for particle state in textures is L. Latta, "Building a Million Particle System", GDC 2004; for light lists
// by tile, O. Olsson and U. Assarsson, "Tiled Shading", JGT 15(4), 2011.) Particles are never made nor lost: one that
// dies is born again as its own type, in the step in which its age reaches its lifetime.

#iUniform float speed = 1.0 in { 0.0, 10.0 }
#iUniform float lifetime = 1.0 in { 0.1, 5.0 }
#iUniform float gravity = 0.45 in { 0.0, 2.0 }
#iUniform float bounce = 0.55 in { 0.0, 1.0 }
#iUniform float wind = 0.10 in { 0.0, 0.5 }
#iUniform float pull = 1.6 in { 0.0, 6.0 }
#iUniform float size = 1.0 in { 0.3, 3.0 }
#iUniform float exposure_seconds = 0.35 in { 0.02, 5.0 }
#iUniform float brightness = 1.0 in { 0.0, 4.0 }

const int SIDE = 32;
const int COUNT = SIDE * SIDE;

// Types. Of eight in a row four are dust, three sparks and one a moth.
const float DUST = 0.0;  // drifts with the wind
const float SPARK = 1.0; // flung up, falls, bounces
const float MOTH = 2.0;  // circles the lamp

float typeOf(int n) {
    int k = n % 8;
    return k < 4 ? DUST : k < 7 ? SPARK : MOTH;
}

const float FLOOR = -0.36; // heights from the middle

ivec2 texelOf(int n) {
    return ivec2(n % SIDE, n / SIDE);
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// Three numbers in 0..1 (M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: pcg3d).
vec3 hash(ivec3 of) {
    uvec3 v = uvec3(of) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

// In heights. A pixel's worth of blur at least, so that a small canvas does not lose what falls between its pixels.
float radiusOf(float type, float canvasHeight) {
    return max(size * (type == DUST ? 0.0045 : type == SPARK ? 0.0040 : 0.0075), 0.7 / canvasHeight);
}

// Beyond three radii a particle has 1e-4 of its light, and is not looked for.
const float REACH = 3.0;

const ivec2 TILES = ivec2(16, 9);
const int TILE = 4; // texels each way

// The lamp: the mouse while it is held, else it wanders.
vec2 lamp(vec4 mouse, float time, vec2 canvas) {
    if (mouse.z > 0.0) return (mouse.zw - 0.5 * canvas) / canvas.y;
    float aspect = canvas.x / canvas.y;
    return vec2(0.36 * aspect * sin(0.43 * time), 0.10 + 0.20 * sin(0.71 * time + 1.0));
}

float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-12), 0.0, 1.0));
}
