// Weakly compressible Navier-Stokes in one pass.
//
// Method: M. Guay, F. Colin, R. Egli, "Simple and Fast Fluids", GPU Pro 2, chapter VII.2, A K Peters 2011. Instead of
// solving a Poisson equation for the pressure, the fluid is allowed to be slightly compressible and its density pushes
// back: p = K rho. One step of a cell then needs nothing but its four neighbours and one look upstream:
//
//     rho' = rho - dt (u . grad rho + rho div u)                               conservation of mass
//     u'   = u(x - dt u) + dt (nu lap u + f) - K grad rho                      conservation of momentum
//
// The first term of u' is semi-Lagrangian advection (J. Stam, "Stable Fluids", SIGGRAPH 1999). Differences are central.
// Units: 1 cell = 1 pixel; time runs dt a sub-step; K is in the paper's form, with one dt already inside, so that sound
// travels at c = sqrt(K / dt) pixels a unit of time. K is the slider `stiffness`, nu is `viscosity`.
//
// The slider `form` chooses between two ways to write this:
//
// 0  The paper's, with the density before the step in the last term. At rest it is stable where nu >= K and nu dt <=
// 1/4 (von
//    Neumann), so that sound is slow, and what the eye takes for a lively flow runs faster than it: at K = 0.4 and dt =
//    0.2 c is 1.41. A density that alternates from cell to cell is seen by none of its differences.
// 1  Forward-backward: the density after the step, rho', in the last term, which every cell works out for its four
// neighbours
//    too, and the mass equation as fluxes from the cell upstream (donor cells), so that not a gram is lost. At rest
//    that is stable without any viscosity; in a flow of 0.4 c up to K dt = 0.15, and 0.45 with viscosity (see
//    soundStep). At the defaults c is 3.3, and a fourth difference takes an alternating density away.
//
// A unit of time is a step over dt, three steps a frame, and lengths are in pixels: at twice the frame rate the fluid runs
// twice as fast against what drives it, which goes by the clock, and on a canvas of twice the height the same flow takes
// twice as long to cross it. The preset fluid-accurate goes by seconds and canvas heights.
//
// A flow is as good as incompressible where it is slower than 0.3 c. The slider `view` shows |u| / c, Mach's number.
//
// A cell is (velocity.x, velocity.y, density, vorticity). The fluid fills rows 1 and up; row 0 is the mouse's memory.

const int CLASSIC = 0;

// nu dt and K dt = (c dt)^2 as they act: no more than a step can bear, from the amplification matrix of all waves in a
// uniform flow of up to MAX_MACH in any direction, with the fluxes and the fourth difference as they are below.
float viscosityStep() {
    return form == CLASSIC ? viscosity * dt : min(viscosity * dt, 0.15);
}

float soundStep() {
    return form == CLASSIC ? stiffness * dt : min(stiffness * dt, min(0.15 + 10.0 * viscosity * dt, 0.45));
}

// Confinement is an explicit force that feeds the shortest eddies most: more of it a step than viscosity takes from
// them, and some that advection takes, ends as noise from cell to cell at the limit of speed (measured: confinement *
// dt = 0.2 without viscosity, 0.4 with nu dt = 0.06).
float confinementHere() {
    return form == CLASSIC ? confinement : min(confinement, (0.1 + 2.5 * viscosityStep()) / dt);
}

// Where the sliders ask for more: Image hatches the foot of the picture.
bool beyondTheMethod() {
    if (form == CLASSIC) return viscosity < stiffness || viscosity * dt > 0.25;
    if (stiffness <= 0.0) return true; // no pressure, no sound, and a limit of speed at which everything stands
    return viscosityStep() < viscosity * dt || soundStep() < stiffness * dt || confinementHere() < confinement;
}

float soundSpeed() {
    return sqrt(soundStep()) / dt;
}

// Vorticity confinement (Fedkiw, Stam, Jensen, "Visual Simulation of Smoke", SIGGRAPH 2001, section 3) returns some of
// the swirl that bilinear advection rubs out. The softening makes the force quadratic near rest: it cannot wake noise.
const float CONFINEMENT_SOFTENING = 1e-2;

// Never reached in calm flow: they bring back what a violent drag has done. MAX_SPEED is that of the paper's form, past
// the sound.
const float MAX_SPEED = 3.0;
const float MAX_MACH = 0.4;
const float MIN_DENSITY = 0.5;
const float MAX_DENSITY = 3.0;

// Speed * dt <= 1 - 4 nu dt: a checkerboard carried a whole cell upstream arrives with its sign turned, and viscosity
// turns it once more; further than this and it grows. Where no speed is slow enough, a crawl is all there is.
float speedLimit() {
    float most = form == CLASSIC ? MAX_SPEED : MAX_MACH * soundSpeed();
    return clamp((1.0 - 4.0 * viscosityStep()) / dt, 0.05, max(most, 0.05));
}

// A speed that something is to be pushed to, held below this part of the sound's.
float subsonic(float wanted, float mach) {
    return form == CLASSIC ? wanted : min(wanted, mach * soundSpeed());
}

// What of a density that alternates from cell to cell, along one axis, a sub-step takes away.
const float SMOOTHING = 0.1;

// What the density limits cut off or add comes back over 1 / RECOVERY sub-steps. The term sums to zero while the mean
// density is 1, so it conserves the mass that is right and mends the mass that is not.
const float RECOVERY = 1e-3;

// Soft boundaries: over the outermost `edge_cells` cells velocity fades, by `edge_drag` a sub-step at the wall, so that
// waves die there instead of ringing in the box.

const vec4 REST = vec4(0.0, 0.0, 1.0, 0.0);

// ---------------------------------------------------------------------------------------------- reading cells

// NaN and infinity have all exponent bits set. Compared as bits: what clamp(), min() and < make of a NaN is undefined
// in GLSL ES 3.00 (section 4.5.1), so none of them can be trusted to stop one.
bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// A cell that cannot be a fluid is one at rest: a broken number, and the zeros of frame 0 or of a part of the canvas
// that a resize has just uncovered. This is all the initialisation there is.
vec4 healed(vec4 q) {
    return isFinite(q) && q.z > 0.0 ? q : REST;
}

// The cell that p mirrors, where p lies beyond a wall.
ivec2 nearestCell(ivec2 p, ivec2 size) {
    p = max(p, ivec2(-1, 1) - p);
    return max(min(p, min(2 * size - 1 - p, size - 1)), ivec2(0, 1));
}

// Beyond a wall lies the mirror image of the cell inside it: same density, opposite normal velocity. With that ghost
// the central differences of the mass equation cancel in pairs, so walls neither leak nor make mass.
vec4 mirrored(vec4 q, ivec2 p, ivec2 size) {
    if (p.x < 0 || p.x >= size.x) q.x = -q.x;
    if (p.y < 1 || p.y >= size.y) q.y = -q.y;
    return q;
}

#define CELL(channel, p, size) mirrored(healed(texelFetch(channel, nearestCell(p, size), 0)), p, size)

// Where the fluid now in cell p was before time t. Held within half a cell of the walls.
vec2 upstream(ivec2 p, vec2 velocity, float t, ivec2 size) {
    return clamp(vec2(p) - t * velocity, vec2(-0.5, 0.5), max(vec2(size), vec2(1.0, 2.0)) - 0.5);
}

// --------------------------------------------------------------------------------------------------- the solver

struct Stencil {
    vec4 centre, left, right, down, up;
    vec4 farLeft, farRight, farDown, farUp;
    vec4 downLeft, downRight, upLeft, upRight;
};

// The mass that flows in a unit of time from cell a to cell b, which have velocities u and v along the way between
// them.
float flux(float a, float u, float b, float v) {
    return 0.5 * (a * u + b * v) - 0.25 * abs(u + v) * (b - a);
}

// The density of a cell after the step: as much leaves a cell as comes to the next.
float flowed(vec4 here, vec4 left, vec4 right, vec4 down, vec4 up) {
    return here.z - dt * (flux(here.z, here.x, right.z, right.x) - flux(left.z, left.x, here.z, here.x)
                          + flux(here.z, here.y, up.z, up.y) - flux(down.z, down.y, here.z, here.y));
}

float fourth(float a, float b, float c, float d, float e) {
    return a - 4.0 * b + 6.0 * c - 4.0 * d + e;
}

// One sub-step of one cell. `arriving` is the velocity found upstream.
vec4 fluidStep(Stencil s, vec2 arriving, ivec2 p, ivec2 size) {
    vec4 dx = 0.5 * (s.right - s.left);
    vec4 dy = 0.5 * (s.up - s.down);
    vec2 gradDensity = vec2(dx.z, dy.z);
    float divergence = dx.x + dy.y;
    float vorticity = dx.y - dy.x;
    vec2 laplacian = (s.left.xy - s.centre.xy) + (s.right.xy - s.centre.xy)
                   + (s.down.xy - s.centre.xy) + (s.up.xy - s.centre.xy);

    // Towards stronger rotation, turned by a right angle: along the rim of the eddy.
    vec2 inward = 0.5 * vec2(abs(s.right.w) - abs(s.left.w), abs(s.up.w) - abs(s.down.w));
    inward /= length(inward) + CONFINEMENT_SOFTENING;
    vec2 force = confinementHere() * vorticity * vec2(inward.y, -inward.x);

    float density;
    if (form == CLASSIC) {
        density = s.centre.z - dt * (dot(s.centre.xy, gradDensity) + s.centre.z * divergence);
    } else {
        float left = flowed(s.left, s.farLeft, s.centre, s.downLeft, s.upLeft);
        float right = flowed(s.right, s.centre, s.farRight, s.downRight, s.upRight);
        float down = flowed(s.down, s.downLeft, s.downRight, s.farDown, s.centre);
        float up = flowed(s.up, s.upLeft, s.upRight, s.centre, s.farUp);
        gradDensity = 0.5 * vec2(right - left, up - down);
        density = flowed(s.centre, s.left, s.right, s.down, s.up)
                - SMOOTHING / 16.0 * (fourth(s.farLeft.z, s.left.z, s.centre.z, s.right.z, s.farRight.z)
                                      + fourth(s.farDown.z, s.down.z, s.centre.z, s.up.z, s.farUp.z));
    }
    density += RECOVERY * (1.0 - density);
    vec2 velocity = arriving + viscosityStep() * laplacian + dt * force - soundStep() / dt * gradDensity;

    vec2 toWall = min(vec2(p) - vec2(0.0, 1.0), vec2(size - 1 - p));
    float open = smoothstep(-1.0, max(edge_cells, 0.0), min(toWall.x, toWall.y));
    velocity *= mix(1.0 - edge_drag, 1.0, open);

    velocity *= min(1.0, speedLimit() / max(length(velocity), 1e-6));
    return healed(vec4(velocity, clamp(density, MIN_DENSITY, MAX_DENSITY), vorticity));
}

// ----------------------------------------------------------------------------------------------------- the hand

// Texel (0, 0): the mouse as the step before saw it (x, y, 1 while held), and for how many seconds nobody has touched
// it. The brush moves from there to where the mouse is now. Sub-steps B and C find the mouse where A has already
// written it, so a drag pushes once a frame although all three steps are the same code.
const ivec2 MOUSE = ivec2(0, 0);
const float IDLE_AT_START = 60.0;

vec4 rememberMouse(vec4 before, vec4 mouse, float seconds) {
    float held = mouse.z > 0.0 ? 1.0 : 0.0;
    // Texel (0, 0) is all zeros only before the first step: `w` starts above zero and is never set below it.
    float idle = !isFinite(before) || before.w <= 0.0 ? IDLE_AT_START : min(before.w + seconds, IDLE_AT_START);
    return vec4(mouse.xy, held, held > 0.0 ? 1e-3 : idle);
}

// 0 while somebody paints, rising to 1 when the picture has been left alone for a while.
float idleness(vec4 memory) {
    return isFinite(memory) && memory.w > 0.0 ? smoothstep(1.0, 4.0, memory.w) : 1.0;
}

// How far p is from the stroke a-b.
float strokeDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-6), 0.0, 1.0));
}

// The brush's weight at p: 1 on the stroke, 0 far away or when the mouse is up.
float brush(vec2 p, vec4 before, vec4 mouse, float radius) {
    if (mouse.z <= 0.0 || before.z <= 0.0) return 0.0;
    float d = strokeDistance(p, before.xy + 0.5, mouse.xy + 0.5) / radius;
    return exp(-d * d);
}

float brushRadius(vec2 resolution) {
    return 0.035 * resolution.y + 1.0;
}

// The fluid under the brush is carried along with it, up to a speed it can follow without being torn.
const float BRUSH_SPEED = 2.2;
const float BRUSH_MACH = 0.4;

// Against a wall, or against its own push of a frame ago, a hand moves nothing: all its force goes into the density,
// which comes to differ by force times length over c^2, and the brush is longer on a larger canvas. The hand's grip
// loosens where the density is off by more than SLIPS, and is gone at SLIDES.
const float SLIPS = 0.15;
const float SLIDES = 0.35;

vec2 drag(vec4 state, vec2 p, vec4 before, vec4 mouse, vec2 resolution) {
    vec2 moved = mouse.xy - before.xy;
    float far = length(moved);
    if (far < 0.5) return state.xy;
    vec2 hand = moved / far * min(far / (SUBSTEPS * dt), subsonic(BRUSH_SPEED, BRUSH_MACH));
    float grip = form == CLASSIC ? 1.0 : clamp((SLIDES - abs(state.z - 1.0)) / (SLIDES - SLIPS), 0.0, 1.0);
    return mix(state.xy, hand, 0.5 * grip * brush(p, before, mouse, brushRadius(resolution)));
}

// ----------------------------------------------------------------------------------------------------- the view

// What the slider `view` shows in place of the picture: 1 Mach's number, green to 0.3 and red from there; 2 the density
// less 1, where blue is too little and red too much, 0.1 at full strength.
vec3 viewOf(vec4 cell) {
    float mach = length(cell.xy) / max(soundSpeed(), 1e-6), off = clamp(10.0 * (cell.z - 1.0), -1.0, 1.0);
    vec3 slow = mix(vec3(0.02, 0.03, 0.06), vec3(0.30, 0.85, 0.35), min(mach / 0.3, 1.0));
    vec3 fast = mix(vec3(1.0, 0.75, 0.1), vec3(0.9, 0.05, 0.05), smoothstep(0.3, 1.0, mach));
    if (view == 1) return mach < 0.3 ? slow : fast;
    return off < 0.0 ? mix(vec3(1.0), vec3(0.1, 0.25, 0.9), -off) : mix(vec3(1.0), vec3(0.9, 0.15, 0.1), off);
}
