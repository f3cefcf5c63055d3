// Of a step.
#iUniform float dt = 0.15 in { 0.0, 20.0 }
#include "vortex.glsl"

vec2 onFaces(vec2 p) {
    return vec2(vortex(p - vec2(0.5, 0.0)).x, vortex(p - vec2(0.0, 0.5)).y);
}

// Velocity: through the left face of a texel, in x, and through the lower one, in y.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(field, (p + 4 * size) % size, 0).xy;
}

#include "pressure_at.glsl"

#include "bilinear.glsl"

vec2 velocityAt(sampler2D field, vec2 p) {
    return vec2(bilinear(field, p + vec2(0.5, 0.0)).x, bilinear(field, p + vec2(0.0, 0.5)).y);
}

// Where what is at `p` was `span` of time ago; negative: where it will be. By the midpoint rule, in the velocity of the
// middle of the step.
vec2 departure(sampler2D drift, vec2 p, float span) {
    return p - span * velocityAt(drift, p - 0.5 * span * velocityAt(drift, p));
}

#include "spread_along.glsl"

vec2 gradient(sampler2D pressure, ivec2 p) {
    return pressureAt(pressure, p) - vec2(pressureAt(pressure, p - ivec2(1, 0)), pressureAt(pressure, p - ivec2(0, 1)));
}
