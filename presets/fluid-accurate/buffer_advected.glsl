// The second step of MacCormack, and the forces. Channel 0 is the drift, channel 1 what is carried, channel 2 the first step,
// channel 3 the mouse.
#include "staggered.glsl"

float corrected(vec2 at, vec2 here, int axis, float cells, float start, float there) {
    return there + 0.5 * (start - cubicAt(iChannel2, path(iChannel0, at, here, -cells), axis));
}

// What the jets and the hand make of a velocity at a place in cells.
vec2 driven(vec2 velocity, vec2 cell, vec2 size) {
    vec2 at = (cell - 0.5 * size) / size.y;
    vec4 mouse = texelFetch(iChannel3, ivec2(0), 0);
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
    ivec2 p = ivec2(fragCoord), size = textureSize(iChannel0, 0);
    float cells = speed * iTimeDelta * float(size.y);
    vec2 own = texelFetch(iChannel0, p, 0).xy, start = texelFetch(iChannel1, p, 0).xy, left = faceAt(p, 0), bottom = faceAt(p, 1);
    vec4 first = texelFetch(iChannel2, p, 0);
    vec2 moved = vec2(corrected(left, vec2(own.x, first.z), 0, cells, start.x, first.x),
                      corrected(bottom, vec2(first.w, own.y), 1, cells, start.y, first.y));
    if (limiter) {
        // To the range of what came to the neighbours: no value appears that was not there.
        vec2 low = first.xy, high = first.xy;
        for (int y = -1; y <= 1; y++) {
            for (int x = -1; x <= 1; x++) {
                vec2 q = texelFetch(iChannel2, clamp(p + ivec2(x, y), ivec2(0), size - 1), 0).xy;
                low = min(low, q);
                high = max(high, q);
            }
        }
        moved = clamp(moved, low, high);
    }
    if (speed > 0.0) moved = vec2(driven(moved, left, vec2(size)).x, driven(moved, bottom, vec2(size)).y);
    if (walls != PERIODIC) moved *= vec2(greaterThan(p, ivec2(0)));
    velocity = isFinite(vec4(moved, 0.0, 0.0)) ? vec4(moved, 0.0, 0.0) : vec4(0.0);
}
