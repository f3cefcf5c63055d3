// The second step of MacCormack, viscosity, and the forces. Channel 0 is the velocity of the last frame, channel 1 the first
// step, channel 2 the mouse.
#define VELOCITY iChannel0
#include "staggered.glsl"

// The first step's result, bilinear, with the walls as staggered.glsl has them.
float first(ivec2 face, int axis) {
    ivec2 size = grid();
    int along = axis == 0 ? face.x : face.y;
    if (along <= 0 || along >= (axis == 0 ? size.x : size.y)) return 0.0;
    return texelFetch(iChannel1, clamp(face, ivec2(0), size - 1), 0)[axis];
}

float firstAt(vec2 at, int axis) {
    vec2 g = inside(at) - (axis == 0 ? vec2(0.0, 0.5) : vec2(0.5, 0.0));
    ivec2 i = ivec2(floor(g));
    vec2 f = g - vec2(i);
    return mix(mix(first(i, axis), first(i + ivec2(1, 0), axis), f.x),
               mix(first(i + ivec2(0, 1), axis), first(i + 1, axis), f.x), f.y);
}

float face(ivec2 i, int axis) {
    return axis == 0 ? across(i) : upwards(i);
}

float corrected(ivec2 p, int axis, float cells) {
    vec2 at = vec2(p) + (axis == 0 ? vec2(0.0, 0.5) : vec2(0.5, 0.0));
    float there = first(p, axis);
    float value = there + 0.5 * (face(p, axis) - firstAt(path(at, -cells), axis));
    if (limiter) {
        ivec2 i = ivec2(floor(path(at, cells) - (axis == 0 ? vec2(0.0, 0.5) : vec2(0.5, 0.0))));
        float a = face(i, axis), b = face(i + ivec2(1, 0), axis), c = face(i + ivec2(0, 1), axis), d = face(i + 1, axis);
        value = clamp(value, min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
    }
    float spread = face(p - ivec2(1, 0), axis) + face(p + ivec2(1, 0), axis) + face(p - ivec2(0, 1), axis)
                 + face(p + ivec2(0, 1), axis) - 4.0 * face(p, axis);
    return value + viscosityHere(speed * iTimeDelta, float(grid().y)) * spread;
}

// What the jets and the hand make of a velocity at a place in cells.
vec2 driven(vec2 velocity, vec2 cell) {
    vec2 size = vec2(grid()), at = (cell - 0.5 * size) / size.y;
    vec4 mouse = texelFetch(iChannel2, ivec2(0), 0);
    if (mouse.z > 0.0) {
        vec2 canvas = size * 2.0;
        vec2 moved = (mouse.zw - mouse.xy) / (canvas.y * max(iTimeDelta, 1e-3));
        float quick = length(moved);
        if (quick > 1e-3) velocity = mix(velocity, moved * min(1.0, 3.0 / quick), 0.6 * brush(at, mouse, canvas));
    } else {
        for (int i = 0; i < JETS; i++) {
            vec4 nozzle = jet(i, iTime, size.x / size.y);
            velocity = mix(velocity, jet_speed * nozzle.zw, 0.25 * jets * jetWeight(at, nozzle));
        }
    }
    return velocity;
}

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float cells = speed * iTimeDelta * float(grid().y);
    vec2 moved = vec2(corrected(p, 0, cells), corrected(p, 1, cells));
    if (speed > 0.0) moved = vec2(driven(moved, vec2(p) + vec2(0.0, 0.5)).x, driven(moved, vec2(p) + vec2(0.5, 0.0)).y);
    if (p.x == 0) moved.x = 0.0;
    if (p.y == 0) moved.y = 0.0;
    velocity = isFinite(vec4(moved, 0.0, 0.0)) ? vec4(moved, 0.0, 0.0) : vec4(0.0);
}
