#define BGK 0
#define CUMULANT 1
#ifndef METHOD
#define METHOD BGK
#endif
// Of a step.
#iUniform float dt = 0.15 in { 0.0, 4.0 }
// In a box (CAVITY) the speed of its upper wall, texels for a unit of time.
#iUniform float lid = 0.0 in { -2.0, 2.0 }
#include "vortex.glsl"

// D2Q9 with one relaxation time (Qian, d'Humieres and Lallemand 1992), or by cumulants (Geier, Schonherr,
// Pasquali and Krafczyk 2015). Populations are stored less their weights, which keeps
// what is small in the small numbers where floats are dense.
const vec4 AXES_X = vec4(1.0, 0.0, -1.0, 0.0), AXES_Y = vec4(0.0, 1.0, 0.0, -1.0);
const vec4 CORNERS_X = vec4(1.0, -1.0, -1.0, 1.0), CORNERS_Y = vec4(1.0, 1.0, -1.0, -1.0);

struct Cell {
    vec4 axes, corners;
    float rest;
};

// Density less 1, and velocity in texels a step.
vec3 moments(Cell f) {
    float rho = f.rest + dot(f.axes, vec4(1.0)) + dot(f.corners, vec4(1.0));
    vec2 momentum = vec2(dot(f.axes, AXES_X) + dot(f.corners, CORNERS_X), dot(f.axes, AXES_Y) + dot(f.corners, CORNERS_Y));
    return vec3(rho, momentum / (1.0 + rho));
}

vec4 equilibrium(vec3 m, float weight, vec4 x, vec4 y) {
    vec4 cu = 3.0 * (m.y * x + m.z * y);
    return weight * (m.x + (1.0 + m.x) * (cu + 0.5 * cu * cu - 1.5 * dot(m.yz, m.yz)));
}

float restEquilibrium(vec3 m) {
    return 4.0 / 9.0 * (m.x - (1.0 + m.x) * 1.5 * dot(m.yz, m.yz));
}

Cell cell(sampler2D axes, sampler2D corners, sampler2D rest, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    p = (p + size) % size;
    return Cell(texelFetch(axes, p, 0), texelFetch(corners, p, 0), texelFetch(rest, p, 0).x);
}

float relaxed() {
    return 1.0 / (0.5 + 3.0 * viscosity * dt);
}

#if METHOD == CUMULANT
// Moments after the collision, less those of the weights: xx, yy and xy of the stress, and the higher ones.
struct Stress {
    float xx, yy, xy, xxy, xyy, xxyy;
};

// The shear stress relaxes with the viscosity. All other cumulants of second and higher order go to their equilibrium at
// once: the trace, which makes the bulk viscosity 1/6, and those of third and fourth order, which is 0. A moment about
// the origin follows from those about the velocity, and the fourth cumulant is xxyy - (xx yy + 2 xy xy) / rho.
Stress stressed(Cell f) {
    vec3 m = moments(f);
    float rho = 1.0 + m.x, u = m.y, v = m.z, keeps = 1.0 - relaxed();
    float difference = f.axes.x - f.axes.y + f.axes.z - f.axes.w - rho * (u * u - v * v);
    float mixed = f.corners.x - f.corners.y + f.corners.z - f.corners.w - rho * u * v;
    float half_difference = 0.5 * keeps * difference, xy = keeps * mixed;
    float xx = rho / 3.0 + half_difference, yy = rho / 3.0 - half_difference;
    Stress s;
    s.xx = m.x / 3.0 + half_difference + rho * u * u;
    s.yy = m.x / 3.0 - half_difference + rho * v * v;
    s.xy = xy + rho * u * v;
    s.xxy = 2.0 * u * xy + v * xx + rho * u * u * v;
    s.xyy = 2.0 * v * xy + u * yy + rho * u * v * v;
    s.xxyy = m.x / 9.0 + (2.0 * xy * xy - half_difference * half_difference) / rho
        + u * u * yy + v * v * xx + 4.0 * u * v * xy + rho * u * u * v * v;
    return s;
}
#endif

vec4 axesAfter(Cell f) {
#if METHOD == CUMULANT
    Stress s = stressed(f);
    vec3 m = moments(f);
    vec2 along = (1.0 + m.x) * m.yz - vec2(s.xyy, s.xxy);
    return 0.5 * (vec4(s.xx, s.yy, s.xx, s.yy) - s.xxyy + vec4(along, -along));
#else
    return mix(f.axes, equilibrium(moments(f), 1.0 / 9.0, AXES_X, AXES_Y), relaxed());
#endif
}

vec4 cornersAfter(Cell f) {
#if METHOD == CUMULANT
    Stress s = stressed(f);
    return 0.25 * (s.xxyy + s.xyy * CORNERS_X + s.xxy * CORNERS_Y + s.xy * CORNERS_X * CORNERS_Y);
#else
    return mix(f.corners, equilibrium(moments(f), 1.0 / 36.0, CORNERS_X, CORNERS_Y), relaxed());
#endif
}

float restAfter(Cell f) {
#if METHOD == CUMULANT
    Stress s = stressed(f);
    return moments(f).x - s.xx - s.yy + s.xxyy;
#else
    return mix(f.rest, restEquilibrium(moments(f)), relaxed());
#endif
}

// Density and velocity of the vortex in lattice units; p = rho / 3.
vec3 begun(vec2 p) {
    vec2 a = 12.566370614359173 * p / iResolution.xy;
    float u = speed * dt;
    return vec3(0.75 * u * u * (cos(a.x) + cos(a.y)), dt * vortex(p));
}

bool isWall(ivec2 p) {
#ifdef CAVITY
    return any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, ivec2(iResolution.xy)));
#else
    return false;
#endif
}

// What a population of direction `x` gets from a moving lid that it bounces off, half-way between the texels.
float dragged(ivec2 from, float weight, float x) {
    return from.y >= int(iResolution.y) ? 6.0 * weight * x * lid * dt : 0.0;
}
