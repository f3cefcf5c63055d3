#define ONE_PASS 0
#define CHAIN 1
#define FORWARD_BACKWARD 2
#ifndef METHOD
#define METHOD ONE_PASS
#endif
// Of a step.
#iUniform float dt = 0.15 in { 0.0, 4.0 }
// In a box (CAVITY) the speed of its upper wall, texels for a unit of time.
#iUniform float lid = 0.0 in { -2.0, 2.0 }
#include "vortex.glsl"
// Of the pressure: the speed of sound is sqrt(stiffness / dt).
#iUniform float stiffness = 0.2 in { 0.0, 1.0 }

// Of the density at first: 0 even, 1 in balance with the vortex.
#iUniform float balance = 0.0 in { 0.0, 1.0 }

// Density that balances the vortex: its pressure times dt / stiffness. An even density begins with a bang of sound.
float densityOf(vec2 p) {
    vec2 a = 12.566370614359173 * p / iResolution.xy;
    return 1.0 + balance * dt / max(stiffness, 1e-6) * 0.25 * speed * speed * (cos(a.x) + cos(a.y));
}

// Beyond a wall lies what makes the velocity on the wall the wall's own, and the same density.
vec4 at(sampler2D state, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
#ifdef CAVITY
    ivec2 q = clamp(p, ivec2(0), size - 1);
    vec4 c = texelFetch(state, q, 0);
    if (p != q) c.xy = vec2(p.y > q.y ? 2.0 * lid : 0.0, 0.0) - c.xy;
    return c;
#endif
    return texelFetch(state, (p + size) % size, 0);
}

vec4 bilinear(sampler2D state, vec2 p) {
#ifdef CAVITY
    p = clamp(p, vec2(0.0), iResolution.xy - 1e-3);
#endif
    vec2 base = floor(p - 0.5), t = p - 0.5 - base;
    ivec2 i = ivec2(base);
    vec4 a = at(state, i), b = at(state, i + ivec2(1, 0)), c = at(state, i + ivec2(0, 1)), d = at(state, i + ivec2(1, 1));
    vec4 low = a + t.x * (b - a), high = c + t.x * (d - c);
    return low + t.y * (high - low);
}

// Guay, Colin and Egli 2011: a texel is (u, v, rho). Density after its equation of transport.
float density(sampler2D state, ivec2 p) {
    vec4 c = at(state, p);
    vec4 dx = 0.5 * (at(state, p + ivec2(1, 0)) - at(state, p - ivec2(1, 0)));
    vec4 dy = 0.5 * (at(state, p + ivec2(0, 1)) - at(state, p - ivec2(0, 1)));
    return c.z - dt * (c.x * dx.z + c.y * dy.z + c.z * (dx.x + dy.y));
}

// Velocity, carried, smoothed, and pushed by the gradient of the density.
vec2 moved(sampler2D state, vec2 fragCoord, vec2 gradient) {
    ivec2 p = ivec2(fragCoord);
    vec2 c = at(state, p).xy;
    vec2 beside = (at(state, p + ivec2(1, 0)).xy - c) + (at(state, p - ivec2(1, 0)).xy - c)
        + (at(state, p + ivec2(0, 1)).xy - c) + (at(state, p - ivec2(0, 1)).xy - c);
    return bilinear(state, fragCoord - dt * c).xy + dt * viscosity * beside - stiffness * gradient;
}

vec4 stepped(sampler2D state, vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 gradient = 0.5 * vec2(at(state, p + ivec2(1, 0)).z - at(state, p - ivec2(1, 0)).z,
        at(state, p + ivec2(0, 1)).z - at(state, p - ivec2(0, 1)).z);
    return vec4(moved(state, fragCoord, gradient), density(state, p), 1.0);
}
