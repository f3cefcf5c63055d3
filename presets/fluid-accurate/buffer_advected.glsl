// MacCormack, corrected: half of what there and back has changed is put right. And the forces. Channel 0 is what is
// carried, channel 1 what came there, channel 2 what came back, channel 3 the mouse.
#include "staggered.glsl"

// What the jets and the hand make of a velocity at a place in cells.
vec2 driven(vec2 velocity, vec2 cell, vec2 size) {
    vec2 at = (cell - 0.5 * size) / size.y;
    vec4 mouse = texelFetch(iChannel3, ivec2(0), 0);
    if (mouse.z > 0.0) {
        vec2 canvas = size * 2.0;
        vec2 moved = (mouse.zw - mouse.xy) / (canvas.y * max(iTimeDelta, 1e-3));
        float quick = length(moved);
        float grip = share(0.6 * brush(at, mouse, canvas), iTimeDelta);
        if (quick > 1e-3) velocity = mix(velocity, moved * min(1.0, 3.0 / quick), grip);
    } else {
        for (int i = 0; i < JETS; i++) {
            vec4 nozzle = jet(i, iTime, size.x / size.y);
            float push = share(0.25 * jets * jetWeight(at, nozzle), speed * iTimeDelta);
            velocity = mix(velocity, jet_speed * nozzle.zw, push);
        }
    }
    return velocity;
}

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), size = textureSize(iChannel0, 0);
    vec2 there = texelFetch(iChannel1, p, 0).xy;
    vec3 back = texelFetch(iChannel2, p, 0).xyz;
    vec2 moved = there + 0.5 * back.z * (texelFetch(iChannel0, p, 0).xy - back.xy);
    if (limiter) {
        // To the range of what came to the neighbours.
        vec2 low = there, high = there;
        for (int y = -1; y <= 1; y++) {
            for (int x = -1; x <= 1; x++) {
                vec2 q = texelFetch(iChannel1, clamp(p + ivec2(x, y), ivec2(0), size - 1), 0).xy;
                low = min(low, q);
                high = max(high, q);
            }
        }
        moved = clamp(moved, low, high);
    }
    if (speed > 0.0) moved = vec2(driven(moved, faceAt(p, 0), vec2(size)).x, driven(moved, faceAt(p, 1), vec2(size)).y);
    if (walls != PERIODIC) moved *= vec2(greaterThan(p, ivec2(0)));
    velocity = isFinite(vec4(moved, 0.0, 0.0)) ? vec4(moved, 0.0, 0.0) : vec4(0.0);
}
