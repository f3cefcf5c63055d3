// An incompressible fluid, second order in space and time, stable at every slider: staggered grid, MacCormack advection
// by cubics, exact viscosity, pressure by one multigrid V-cycle a frame.
//
// - Grid: F. Harlow, J. Welch, "Numerical Calculation of Time-Dependent Viscous Incompressible Flow of Fluid with Free
//   Surface", Phys. Fluids 8, 1965. A texel's x is the velocity through its left face, y through its bottom face; the
//   faces of the right and upper wall need no texel, as nothing flows through them.
// - A step is symmetric in time: half of the viscosity, half of the push of the pressure, advection, the other halves,
//   and what the pressure has changed by. That is an incremental pressure correction (J. van Kan, SIAM J. Sci. Stat.
//   Comput. 7, 1986) along paths. Pushed only after advection the method is of first order: 0.05 instead of 0.00015 in
//   the first case below.
// - Advection: A. Selle, R. Fedkiw, B. Kim, Y. Liu, J. Rossignac, "An Unconditionally Stable MacCormack Method", J.
//   Sci. Comput. 35, 2008: there, back, half of what that loses added; cut to the range it came from. Their bilinear
//   interpolation is bicubic here. Paths by the midpoint rule through the velocity in the middle of the step, which is
//   extrapolated from the last two; a velocity at the step's beginning makes what the flow carries arrive late, again
//   by first order. Where the flow deforms by more than 1 in a step, paths cross, the way back means nothing, and only
//   the way there is taken.
// - Pace: where the sliders ask for steps in which the flow would deform by more than 2 (neighbouring cells part by two
//   cells), each step is shortened to that, time in the fluid goes slower, and Image hatches the foot of the picture. A
//   lid of speed 2 without viscosity at ten times the speed else made the fluid five times as fast as itself; now nothing
//   is faster than 1.1 times the lid. Left alone at its defaults, the preset never gets there.
// - Viscosity: the heat equation solved exactly in time and to fourth order in space (heat.glsl), so that no viscosity and
//   no step is too much.
// - Pressure: div grad q = div u, then u -= grad q, which on this grid leaves exactly the residual of q as divergence.
//   One V(2,2)-cycle (A. Brandt, "Multi-Level Adaptive Solutions to Boundary-Value Problems", Math. Comp. 31, 1977;
//   weighted Jacobi 0.8) a frame: ten grids, each half of the one before, so that the coarsest has a handful of cells
//   on any canvas that a device can draw; grids of one cell, which change nothing, are not drawn (`when` in eddy.toml). (With seven it had 15 x 8 at 1920 x 1080, which 40 sweeps do not solve: what
//   they left grew from frame to frame.) It begins where the last frame ended, as q is what the pressure changes by.
//   What it leaves is at most 0.2 of the divergence (root mean square, canvases from 1920 x 1080 to 66 x 250, odd ones
//   among them), and the next frame's takes up the rest. Twenty Jacobi sweeps leave more than 0.9 of the long waves.
//
// Measured on 128 x 128 cells; U is the greatest speed, 1, in a box of 1:
// - Taylor's and Green's eddies at half a cell a step, t = 1: relative L2 error below 0.0003, in a wind of U / 2 below
//   0.0006; a quarter of it for each halving of the cells.
// - Two shear layers that roll up (Brown, Minion 1995), nu = 1e-4, t = 1: their energy within 0.001 of a spectral
//   method's.
// - The cavity of Ghia, Ghia, Shin, two cells a step: within 0.004 of the tables at Re = 400 and 0.01 at Re = 100; at
//   Re = 1000 within 0.009 of a high-order method, from which the table itself is 0.0185 off. No noise at the lid.
//
// Units: canvas heights and seconds. The grid is half the canvas each way; the dye has every pixel. Jets and hand push by
// the second, not by the frame: a frame rate of 30, 60 or 144 gives the same flow until eddies part by chance. So does a
// canvas of another size, as far as its cells resolve the jets.

// Canvas heights squared a second.
#iUniform float viscosity = 0.0 in { 0.0, 0.01 }
// Time against the clock's, where the flow bears such steps.
#iUniform float speed = 1.0 in { 0.0, 10.0 }
#iUniform bool limiter = true
// 0: walls along which the fluid slips, 1: walls to which it sticks, 2: none, the picture repeats.
#iUniform int walls = 0 in { 0, 2 }
// With walls of kind 1, how fast the upper one moves, in heights a second.
#iUniform float lid_speed = 0.0 in { -2.0, 2.0 }
#iUniform float jets = 1.0 in { 0.0, 1.0 }
#iUniform float jet_speed = 0.55 in { 0.0, 2.0 }
#iUniform float fade_seconds = 14.0 in { 0.5, 120.0 }
#iUniform float brush_size = 0.045 in { 0.01, 0.2 }

const int NO_SLIP = 1, PERIODIC = 2; // values of `walls`; 0 is free slip

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// What the pace is in its buffer, and the step at it, in seconds of the fluid.
float paceIn(sampler2D buffer_pace) {
    vec4 pace = texelFetch(buffer_pace, ivec2(0), 0);
    return isFinite(pace) ? clamp(pace.x, 0.0, 1.0) : 1.0;
}

float stepNow(sampler2D buffer_pace) {
    return speed * iTimeDelta * paceIn(buffer_pace);
}

// Cells squared in so many seconds.
float viscosityHere(float seconds, float rows) {
    return viscosity * seconds * rows * rows;
}

// The most that the flow may deform in a step, as a difference of the velocity across a cell times the step in cells.
const float MOST_DEFORMATION = 2.0;

// What the pressure times the last step, `before`, is multiplied by to be times this one. 0 where there was no step.
float stepRatio(float before, float now) {
    return before > 0.0 ? min(now / before, 4.0) : 0.0;
}

// --------------------------------------------------------------------------------------------- forces: jets and a hand

const int JETS = 3;

// What pushes or pours takes the fluid to what it wants by this part of the way in so many seconds, where in a 60th it
// takes it by `sixtieth`: the same in a second at any frame rate.
float share(float sixtieth, float seconds) {
    return 1.0 - pow(1.0 - min(sixtieth, 0.999), 60.0 * seconds);
}

// (x, y, cos, sin): position in heights from the canvas's middle, direction.
vec4 jet(int i, float time, float aspect) {
    float turn = 0.17 * time + 2.0943951 * float(i);
    vec2 at = vec2(0.36 * aspect * cos(turn), 0.36 * sin(turn));
    float facing = turn + 3.14159265 + 0.6 * sin(0.45 * time + 1.7 * float(i));
    return vec4(at, cos(facing), sin(facing));
}

float jetWeight(vec2 at, vec4 nozzle) {
    float d = length(at - nozzle.xy) / 0.028;
    return exp(-d * d);
}

// How far p is from the segment a-b.
float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-9), 0.0, 1.0));
}

// The brush's weight: `mouse` is in canvas pixels, before and now; `at` in heights from the middle.
float brush(vec2 at, vec4 mouse, vec2 canvas) {
    if (mouse.z <= 0.0) return 0.0;
    float d = segmentDistance(at, (mouse.xy - 0.5 * canvas) / canvas.y, (mouse.zw - 0.5 * canvas) / canvas.y)
        / brush_size;
    return exp(-d * d);
}
