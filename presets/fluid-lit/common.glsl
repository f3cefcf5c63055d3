// What can be turned, and the spoons. The fluid's method is in solver.glsl, one sub-step of it in step.glsl.

// Image hatches the foot of the picture where these ask for more than the method can do.
#iUniform float viscosity = 0.35 in { 0.0, 1.25 } // thickness of the fluid. Red hatching: more than the method can do, which then uses less
#iUniform float stiffness = 2.2 in { 0.0, 10.0 } // resistance to compression. Red hatching: more than the method can do, which then uses less
#iUniform float dt = 0.2 in { 0.02, 2.0 } // time step. Red hatching: more than the method can do, which then uses less
// 0: the method as it was published, for which stiffness 0.4 and viscosity 0.5 are right; 1: forward-backward
// (solver.glsl).
#iUniform int form = 1 in { 0, 1 } // method: 0 as published (stiffness 0.4, viscosity 0.5), 1 forward-backward
// 0: the picture, 1: Mach's number, 2: the density.
#iUniform int view = 0 in { 0, 2 } // shows: 0 picture, 1 Mach number, 2 density
#iUniform float confinement = 0.05 in { 0.0, 2.0 }
#iUniform float edge_cells = 8.0 in { 0.0, 64.0 }
#iUniform float edge_drag = 0.15 in { 0.0, 1.0 }

// The surface: how deep an eddy dents it, in how many seconds a dent is gone, and how steep it is shown.
#iUniform float dent = 1.6 in { 0.0, 4.0 }
#iUniform float settle_seconds = 6.0 in { 0.1, 20.0 }
// How high the long waves are to which it settles.
#iUniform float swell = 0.16 in { 0.0, 0.5 }
// Surface tension: what of a wrinkle one pixel wide is smoothed out in a frame.
#iUniform float tension = 0.8 in { 0.0, 1.0 }
#iUniform float relief = 1.0 in { 0.0, 4.0 }
#iUniform float shininess = 60.0 in { 2.0, 300.0 }
#iUniform color3 liquid = color3(0.006, 0.070, 0.095)
#iUniform color3 warm = color3(1.00, 0.38, 0.06)
#iUniform color3 deep = color3(0.10, 0.03, 0.24)
#iUniform float spoons = 1.0 in { 0.0, 1.0 }

const float SUBSTEPS = 3.0; // a frame; the same number as in eddy.toml

#include "solver.glsl"

// Three spoons stir while nobody else does. (x, y, cos, sin): position in pixels, direction.
const int SPOONS = 3;

vec2 spoonAt(int i, float time, vec2 resolution) {
    float side = float(i) - 1.0, turn = (i == 1 ? -0.34 : 0.40) * time + 2.1 * float(i);
    return resolution * (0.5 + vec2(0.27 * side + 0.17 * cos(turn), 0.29 * sin(1.3 * turn + 0.4)));
}

vec4 spoon(int i, float time, vec2 resolution) {
    vec2 at = spoonAt(i, time, resolution);
    vec2 along = spoonAt(i, time + 0.05, resolution) - at;
    return vec4(at, along / max(length(along), 1e-6));
}

vec2 emit(vec2 velocity, vec2 p, float time, float strength, vec2 resolution) {
    for (int i = 0; i < SPOONS; i++) {
        vec4 at = spoon(i, time, resolution);
        float d = length(p - at.xy) / (0.04 * resolution.y + 0.5);
        velocity = mix(velocity, subsonic(2.2, 0.24) * at.zw, 0.12 * spoons * strength * exp(-d * d));
    }
    return velocity;
}
