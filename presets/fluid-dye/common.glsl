// What can be turned, and the emitter. The fluid's method is in solver.glsl, one sub-step of it in step.glsl.

// Image hatches the foot of the picture where these ask for more than the method can do.
#iUniform float viscosity = 0.25 in { 0.0, 1.25 } // thickness of the fluid. Red hatching: more than the method can do, which then uses less
#iUniform float stiffness = 2.2 in { 0.0, 10.0 } // resistance to compression. Red hatching: more than the method can do, which then uses less
#iUniform float dt = 0.2 in { 0.02, 2.0 } // time step. Red hatching: more than the method can do, which then uses less
// 0: the method as it was published, for which stiffness 0.4 and viscosity 0.5 are right; 1: forward-backward
// (solver.glsl).
#iUniform int form = 1 in { 0, 1 } // method: 0 as published (stiffness 0.4, viscosity 0.5), 1 forward-backward
// 0: the picture, 1: Mach's number, 2: the density.
#iUniform int view = 0 in { 0, 2 } // shows: 0 picture, 1 Mach number, 2 density
#iUniform float confinement = 0.25 in { 0.0, 2.0 }
#iUniform float edge_cells = 8.0 in { 0.0, 64.0 }
#iUniform float edge_drag = 0.15 in { 0.0, 1.0 }

// Seconds in which red, green and blue fall to 1/e: dye is white when it is young and blue when it is old.
#iUniform vec3 decay_seconds = vec3(1.3, 2.4, 7.0) in { 0.1, 30.0 }
// What an emitter pours out at its middle, in a second.
#iUniform vec3 pours = vec3(14.0, 6.5, 3.4) in { 0.0, 20.0 }
// How hard it blows, in pixels a unit of time; 0: the dye just wells up.
#iUniform float blows = 2.2 in { 0.0, 3.0 }
#iUniform float exposure = 1.2 in { 0.1, 4.0 }

const float SUBSTEPS = 3.0; // a frame; the same number as in eddy.toml

#include "solver.glsl"

// Two nozzles at the ends of a beam that turns, each blowing across it. (x, y, cos, sin): position in pixels,
// direction.
const int EMITTERS = 2;

vec4 emitter(int i, float time, vec2 resolution) {
    float turn = 0.55 * time + 0.8 * sin(0.23 * time) + 3.14159265 * float(i);
    float reach = 0.30 * min(resolution.x, resolution.y);
    vec2 centre = 0.5 * resolution + 0.12 * resolution * vec2(sin(0.31 * time), sin(0.43 * time));
    float facing = turn + 1.9 + 0.7 * sin(1.3 * time + float(i));
    return vec4(centre + reach * vec2(1.3 * cos(turn), sin(turn)), cos(facing), sin(facing));
}

float emitterRadius(vec2 resolution) {
    return 0.026 * resolution.y + 0.5;
}

// 1 at the nozzle; over all pixels it sums to pi * emitterRadius^2.
float emitterWeight(vec2 p, vec4 nozzle, vec2 resolution) {
    float d = length(p - nozzle.xy) / emitterRadius(resolution);
    return exp(-d * d);
}

vec2 emit(vec2 velocity, vec2 p, float time, float strength, vec2 resolution) {
    for (int i = 0; i < EMITTERS; i++) {
        vec4 nozzle = emitter(i, time, resolution);
        float w = blows > 0.0 ? 0.10 * strength * emitterWeight(p, nozzle, resolution) : 0.0;
        velocity = mix(velocity, subsonic(blows, 0.27) * nozzle.zw, w);
    }
    return velocity;
}
