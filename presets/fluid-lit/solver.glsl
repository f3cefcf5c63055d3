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
// travels at sqrt(K / dt) pixels a unit of time.
// K is the slider `stiffness`, nu is `viscosity`.
//
// A cell is (velocity.x, velocity.y, density, vorticity). The fluid fills rows 1 and up; row 0 is the mouse's memory.

// Linear stability at rest (von Neumann): it needs nu >= K, whatever dt is, and nu * dt <= 1/4. nu = K is the least
// viscosity the method can do in one pass; below it standing sound waves of every length grow, at nu = 0 by
// sqrt(1 + K dt sin^2 k) a step. The default margin is for flow: the mass equation is explicit and central, which feeds
// short waves at a rate of (u dt)^2 / 2.
bool beyondTheMethod() {
    return viscosity < stiffness || viscosity * dt > 0.25;
}

// Vorticity confinement (Fedkiw, Stam, Jensen, "Visual Simulation of Smoke", SIGGRAPH 2001, section 3) returns some of
// the swirl that bilinear advection rubs out. The softening makes the force quadratic near rest: it cannot wake noise.
const float CONFINEMENT_SOFTENING = 1e-2;

// Never reached in calm flow. A violent drag drives the density out of the range in which the linear pressure means
// anything, and the velocity past the sound; these bring both back.
const float MAX_SPEED = 3.0;
const float MIN_DENSITY = 0.5;
const float MAX_DENSITY = 3.0;

// Speed * dt <= 1 - 4 nu dt: a checkerboard carried a whole cell upstream arrives with its sign turned, and viscosity
// turns it once more; further than this and it grows. Where no speed is slow enough, a crawl is all there is.
float speedLimit() {
    return clamp((1.0 - 4.0 * viscosity * dt) / dt, 0.05, MAX_SPEED);
}

// What the density limits cut off or add comes back over 1 / RECOVERY sub-steps. The term sums to zero while the mean
// density is 1, so it conserves the mass that is right and mends the mass that is not.
const float RECOVERY = 1e-3;

// Soft boundaries: over the outermost `edge_cells` cells velocity fades, by `edge_drag` a sub-step at the wall, so that
// waves die there instead of ringing in the box.

const vec4 REST = vec4(0.0, 0.0, 1.0, 0.0);

// ---------------------------------------------------------------------------------------------------- reading cells

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

ivec2 nearestCell(ivec2 p, ivec2 size) {
    return max(min(p, size - 1), ivec2(0, 1));
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

// --------------------------------------------------------------------------------------------------------- the solver

struct Stencil {
    vec4 centre, left, right, down, up;
};

// One sub-step of one cell. `arriving` is the velocity found upstream.
vec4 fluidStep(Stencil s, vec2 arriving, ivec2 p, ivec2 size) {
    vec4 dx = 0.5 * (s.right - s.left);
    vec4 dy = 0.5 * (s.up - s.down);
    vec2 gradDensity = vec2(dx.z, dy.z);
    float divergence = dx.x + dy.y;
    float vorticity = dx.y - dy.x;
    vec2 laplacian = s.left.xy + s.right.xy + s.down.xy + s.up.xy - 4.0 * s.centre.xy;

    // Towards stronger rotation, turned by a right angle: along the rim of the eddy.
    vec2 inward = 0.5 * vec2(abs(s.right.w) - abs(s.left.w), abs(s.up.w) - abs(s.down.w));
    inward /= length(inward) + CONFINEMENT_SOFTENING;
    vec2 force = confinement * vorticity * vec2(inward.y, -inward.x);

    float density = s.centre.z - dt * (dot(s.centre.xy, gradDensity) + s.centre.z * divergence);
    density += RECOVERY * (1.0 - density);
    vec2 velocity = arriving + dt * (viscosity * laplacian + force) - stiffness * gradDensity;

    vec2 toWall = min(vec2(p) - vec2(0.0, 1.0), vec2(size - 1 - p));
    float open = smoothstep(-1.0, max(edge_cells, 0.0), min(toWall.x, toWall.y));
    velocity *= mix(1.0 - edge_drag, 1.0, open);

    velocity *= min(1.0, speedLimit() / max(length(velocity), 1e-6));
    return healed(vec4(velocity, clamp(density, MIN_DENSITY, MAX_DENSITY), vorticity));
}

// ----------------------------------------------------------------------------------------------------------- the hand

// Texel (0, 0): the mouse as the step before saw it (x, y, 1 while held), and for how many seconds nobody has touched it.
// The brush moves from there to where the mouse is now. Sub-steps B and C find the mouse where A has already written
// it, so a drag pushes once a frame although all three steps are the same code.
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

vec2 drag(vec2 velocity, vec2 p, vec4 before, vec4 mouse, vec2 resolution) {
    vec2 moved = mouse.xy - before.xy;
    float far = length(moved);
    if (far < 0.5) return velocity;
    vec2 hand = moved / far * min(far / (SUBSTEPS * dt), BRUSH_SPEED);
    return mix(velocity, hand, 0.5 * brush(p, before, mouse, brushRadius(resolution)));
}
