// Of a step.
#iUniform float dt = 0.15 in { 0.0, 20.0 }
// In a box (CAVITY) the speed of its upper wall, texels for a unit of time.
#iUniform float lid = 0.0 in { -2.0, 2.0 }
#include "vortex.glsl"

#include "mirrored_walls.glsl"

#include "pressure_at.glsl"

#include "spread_along.glsl"

#include "gradient.glsl"
