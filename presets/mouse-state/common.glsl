// Two ways of remembering where the mouse was. iMouse says where it is; a stroke needs where it was a frame ago as
// well, and a shader has no memory but its buffers. Buffer A and Buffer B draw the same strokes, and differ in where
// the memory lies:
//
//   A   texel (0, 0), by its address. The first row is not part of the picture. A resize keeps the bottom left corner,
//   so
//       the memory survives it.
//   B   the texel at a fixed place in uv, here the top right corner, by a sampler. Nothing needs to know the size; but
//   a
//       linear filter would mix the neighbours into it, and after a resize the place is another texel. So the memory is
//       signed with the size it was written at, and a signature that does not fit is no memory.
//
// A memory is (x, y, 1 while held, signature). Ink never has a negative alpha; a signature always has.

const ivec2 MEMORY = ivec2(0, 0);
const vec2 MEMORY_UV = vec2(0.99999); // the last texel of each axis, up to 100,000 of them

#iUniform float fade = 5.0 in { 0.2, 20.0 }    // seconds until a stroke has 1/e of its strength
#iUniform float brush = 0.016 in { 0.002, 0.1 } // of the canvas' height
#iUniform int copies = 6 in { 1, 12 }          // how many pens draw, turned about the middle; every other is mirrored

// A whole number, exact as a float for any canvas up to 4096 x 4096.
float signature(vec2 resolution) {
    return -(resolution.x + 4096.0 * (resolution.y - 1.0));
}

// The mouse, or while nobody has touched it a hand on a rose curve. x, y in pixels, z 1 while held.
vec3 hand(vec4 mouse, float time, vec2 resolution) {
    if (mouse.z > 0.0 || abs(mouse.x) + abs(mouse.y) > 0.0) return vec3(mouse.xy, mouse.z > 0.0 ? 1.0 : 0.0);
    float r = 0.42 * min(resolution.x / 1.6, resolution.y) * cos(2.5 * 0.9 * time);
    return vec3(0.5 * resolution + r * vec2(1.6, 1.0) * vec2(cos(0.9 * time), sin(0.9 * time)), 1.0);
}

vec4 remember(vec3 hand, vec2 resolution) {
    return vec4(hand, signature(resolution));
}

bool isMemory(vec4 q, vec2 resolution) {
    return q.w == signature(resolution);
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

vec3 hue(float turn) {
    return 0.52 + 0.48 * cos(6.2832 * (turn - vec3(0.02, 0.36, 0.62)));
}

// The ink at a pixel a frame later: what was there fades, and the hand's way since then is drawn over it, coloured by
// its direction and thin where it was fast.
vec4 draw(vec4 ink, vec2 pixel, vec4 before, vec3 now, vec2 resolution, float seconds) {
    if (!isFinite(ink) || ink.a < 0.0) ink = vec4(0.0); // broken, or a memory of another size
    ink *= exp(-seconds / fade);
    bool drawing = isMemory(before, resolution) && before.z > 0.5 && now.z > 0.5;
    if (!drawing) return ink;
    vec2 middle = 0.5 * resolution, from = before.xy + 0.5 - middle, along = now.xy - before.xy, p = pixel - middle;
    float far = length(along), radius = brush * resolution.y / (1.0 + 8.0 * far / resolution.y) + 0.8;
    vec3 colour = hue(0.5 * atan(along.y, along.x) / 3.1416 + 0.35 * length(from) / resolution.y);
    for (int i = 0; i < copies; i++) {
        // The first pen is the hand itself: it must be where the hand is.
        float turn = 6.2832 * float(i) / float(copies), s = sin(turn), c = cos(turn);
        vec2 q = vec2(c * p.x + s * p.y, c * p.y - s * p.x);
        if ((i & 1) == 1) q.y = -q.y;
        q -= from;
        float t = clamp(dot(q, along) / max(far * far, 1e-6), 0.0, 1.0), d = length(q - t * along) / radius;
        // Thick in the middle, so that the light finds a ridge; nothing where the hand rests.
        float weight = exp(-1.4 * d * d) * min(far / 0.5, 1.0), height = max(ink.a, weight);
        ink = vec4(mix(ink.rgb / max(ink.a, 1e-3), colour, weight) * height, height);
    }
    return ink;
}
