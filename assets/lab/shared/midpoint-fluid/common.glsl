// Of a step.
#iUniform float dt = 0.15 in { 0.0, 20.0 }
// In a box (CAVITY) the speed of its upper wall, texels for a unit of time.
#iUniform float lid = 0.0 in { -2.0, 2.0 }
#include "vortex.glsl"

#include "mirrored_walls.glsl"

#include "pressure_at.glsl"

#include "bilinear.glsl"

// Where what is at `p` was `span` of time ago; negative: where it will be. By the midpoint rule, in the velocity of the
// middle of the step.
vec2 departure(sampler2D drift, vec2 p, float span) {
    vec2 middle = p - 0.5 * span * at(drift, ivec2(p));
    return p - span * bilinear(drift, middle);
}

#include "spread_along.glsl"

#include "gradient.glsl"
