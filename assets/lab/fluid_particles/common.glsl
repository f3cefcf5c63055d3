// METHOD: what a particle keeps. APIC: the velocity of the grid about it and its gradient (C. Jiang, C. Schroeder,
// A. Selle, J. Teran, A. Stomakhin, "The affine particle-in-cell method", ACM Transactions on Graphics 34 (4),
// 2015). FLIP: its own velocity, to which is added what the grid's has changed by (J. U. Brackbill, H. M. Ruppel,
// "FLIP", Journal of Computational Physics 65 (2), 1986).
#define APIC 0
#define FLIP 1
#ifndef METHOD
#define METHOD APIC
#endif

// Of a step.
#iUniform float dt = 0.15 in { 0.0, 20.0 }
#include "vortex.glsl"

// A cell holds up to SIDE x SIDE particles, each a texel: where it is, from the cell's lower left corner, and how fast.
const int SIDE = 3;
const int MOST = SIDE * SIDE;
// A cell with fewer gets new ones.
const int LEAST = 3;

const vec4 EMPTY = vec4(-9.0, -9.0, 0.0, 0.0);
// The velocity of a new one, which it takes from the grid.
const float UNKNOWN = 1e9;

bool isEmpty(vec4 particle) {
    return particle.x < -8.0;
}

// A place in the cell by the numbers of a cell's slot and of a frame (T. Wang's integer hash, 1997).
vec4 newParticle(ivec2 slot, int frame) {
    uint h = uint(slot.x) + 8192u * uint(slot.y) + 2654435761u * uint(frame);
    h = (h ^ 61u) ^ (h >> 16u);
    h *= 9u;
    h ^= h >> 4u;
    h *= 0x27d4eb2du;
    h ^= h >> 15u;
    return vec4(vec2(h & 0xffffu, h >> 16u) / 65536.0, UNKNOWN, UNKNOWN);
}

// Four to a cell at first, one in each quarter.
vec4 firstParticle(vec2 p) {
    ivec2 slot = ivec2(p), place = slot % SIDE;
    if (any(greaterThan(place, ivec2(1)))) return EMPTY;
    vec4 particle = newParticle(slot, 0);
    return vec4(0.5 * (vec2(place) + particle.xy), particle.zw);
}

// A particle of a cell, which may be beyond the edge.
vec4 particleAt(sampler2D particles, ivec2 cell, int slot) {
    ivec2 cells = textureSize(particles, 0) / SIDE;
    return texelFetch(particles, SIDE * ((cell + cells) % cells) + ivec2(slot % SIDE, slot / SIDE), 0);
}

// What quadratic B-splines give a particle `place` from a cell's corner of the three centres along each axis.
vec2[3] weights(vec2 place) {
    vec2 d = fract(place) - 0.5;
    return vec2[3](0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d));
}

vec4 splined(sampler2D field, ivec2 cell, vec2 place) {
    ivec2 size = textureSize(field, 0), middle = cell + ivec2(floor(place)) + size;
    vec2[3] w = weights(place);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 d = ivec2(i % 3, i / 3);
        sum += w[d.x].x * w[d.y].y * texelFetch(field, (middle + d - 1) % size, 0);
    }
    return sum;
}

// Velocity of the grid.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = textureSize(field, 0);
    return texelFetch(field, (p + 4 * size) % size, 0).xy;
}

#include "pressure_at.glsl"

#include "spread_along.glsl"

#include "gradient.glsl"
