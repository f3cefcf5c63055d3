#define SEMI_LAGRANGIAN 0
#define MACCORMACK 1
#ifndef METHOD
#define METHOD MACCORMACK
#endif
// Of a step.
#iUniform float dt = 0.15 in { 0.0, 4.0 }
// In a box (CAVITY) the speed of its upper wall, texels for a unit of time.
#iUniform float lid = 0.0 in { -2.0, 2.0 }
#include "vortex.glsl"

// Velocity. Beyond a wall lies what makes that on the wall the wall's own.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
#ifdef CAVITY
    ivec2 q = clamp(p, ivec2(0), size - 1);
    vec2 u = texelFetch(field, q, 0).xy;
    return p == q ? u : vec2(p.y > q.y ? 2.0 * lid : 0.0, 0.0) - u;
#else
    return texelFetch(field, (p + size) % size, 0).xy;
#endif
}

#include "pressure_at.glsl"

#include "bilinear.glsl"
