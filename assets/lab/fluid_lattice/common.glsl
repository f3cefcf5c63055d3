// Of a step.
#iUniform float dt = 0.15 in { 0.0, 4.0 }
// Texels^2 for a unit of time.
#iUniform float viscosity = 0.55 in { 0.0, 2.0 }
// Texels for a unit of time.
#iUniform float speed = 0.5 in { 0.0, 2.0 }
// In a box (CAVITY) the speed of its upper wall, texels for a unit of time.
#iUniform float lid = 0.0 in { -2.0, 2.0 }
// Amplitude of noise on top of the vortex.
#iUniform float noise = 0.0 in { 0.0, 1.0 }

// A Taylor-Green vortex of one wave in the box.
vec2 vortex(vec2 p) {
    vec2 a = 6.2831853071795865 * p / iResolution.xy;
    vec2 random = fract(sin(vec2(dot(p, vec2(12.9898, 78.233)), dot(p, vec2(39.346, 11.135)))) * 43758.547) - 0.5;
    return speed * vec2(sin(a.x) * cos(a.y), -cos(a.x) * sin(a.y)) + 2.0 * noise * random;
}

// D2Q9 with one relaxation time (Qian, d'Humieres and Lallemand 1992). Populations are stored less their weights, which keeps
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
