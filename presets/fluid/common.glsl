// What can be turned, and the three nozzles. The method is in solver.glsl, one sub-step of it in step.glsl.

// The numbers of the method; Image hatches the foot of the picture where they ask for more than it can do.
#iUniform float viscosity = 0.3 in { 0.0, 1.25 } // thickness of the fluid. Red hatching: more than the method can do, which then uses less
#iUniform float stiffness = 2.2 in { 0.0, 10.0 } // resistance to compression. Red hatching: more than the method can do, which then uses less
#iUniform float dt = 0.2 in { 0.02, 2.0 } // time step. Red hatching: more than the method can do, which then uses less
// 0: the method as it was published, for which stiffness 0.4 and viscosity 0.5 are right; 1: forward-backward
// (solver.glsl).
#iUniform int form = 1 in { 0, 1 } // method: 0 as published (stiffness 0.4, viscosity 0.5), 1 forward-backward
// 0: the picture, 1: Mach's number, 2: the density.
#iUniform int view = 0 in { 0, 2 } // shows: 0 picture, 1 Mach number, 2 density

// Look, not physics: 0 switches each of them off.
#iUniform float confinement = 0.2 in { 0.0, 2.0 }
#iUniform float edge_cells = 8.0 in { 0.0, 64.0 }
#iUniform float edge_drag = 0.15 in { 0.0, 1.0 }
#iUniform float nozzles = 1.0 in { 0.0, 1.0 }
#iUniform float fade_seconds = 9.0 in { 0.5, 60.0 }
#iUniform float relief = 3.5 in { 0.0, 10.0 }

const float SUBSTEPS = 3.0; // a frame: Buffer A, B, C

#include "solver.glsl"

// ------------------------------------------------------------------------------------------------- the emitters

const int EMITTERS = 3;

// Three nozzles that wander and turn: they keep the picture alive while nobody paints.
// (x, y, cos, sin): position in pixels, direction.
vec4 emitter(int i, float time, vec2 resolution) {
    float phase = 2.0944 * float(i);
    float turn = 0.35 * time + phase;
    vec2 centre = 0.5 * resolution + vec2(0.30 * resolution.x, 0.28 * resolution.y)
        * vec2(cos(turn), sin(1.3 * turn + phase));
    float facing = turn + 2.2 + 0.9 * sin(0.7 * time + 2.0 * phase);
    return vec4(centre, cos(facing), sin(facing));
}

float emitterWeight(vec2 p, vec4 nozzle, vec2 resolution) {
    float d = length(p - nozzle.xy) / (0.032 * resolution.y + 0.5);
    return exp(-d * d);
}

// Streams that meet are faster than the nozzles: at Mach 0.25 of these, less than 1 % of the fluid is faster than 0.3, and
// none at the solver's limit of 0.4.
const float JET_SPEED = 1.8, JET_MACH = 0.25;

vec2 emit(vec2 velocity, vec2 p, float time, float strength, vec2 resolution) {
    for (int i = 0; i < EMITTERS; i++) {
        vec4 nozzle = emitter(i, time, resolution);
        velocity = mix(velocity, subsonic(JET_SPEED, JET_MACH) * nozzle.zw,
                       0.08 * nozzles * strength * emitterWeight(p, nozzle, resolution));
    }
    return velocity;
}
