// Of a step.
#iUniform float dt = 0.15 in { 0.0, 20.0 }
// Texels^2 for a unit of time.
#iUniform float viscosity = 0.55 in { 0.0, 2.0 }
// Texels for a unit of time.
#iUniform float speed = 0.5 in { 0.0, 2.0 }
// Amplitude of noise on top of the vortex.
#iUniform float noise = 0.0 in { 0.0, 1.0 }

// Two numbers in 0..1 for a point of the grid of half texels, of integers alone and so the same on every GPU: pcg2d (M.
// Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020).
vec2 hash(vec2 p) {
    uvec2 v = uvec2(ivec2(floor(2.0 * p + 0.25))) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return vec2(v >> 8u) / 16777216.0;
}

// A Taylor-Green vortex of one wave in the box.
vec2 vortex(vec2 p) {
    vec2 a = 6.2831853071795865 * p / iResolution.xy;
    return speed * vec2(sin(a.x) * cos(a.y), -cos(a.x) * sin(a.y)) + 2.0 * noise * (hash(p) - 0.5);
}

vec2 onFaces(vec2 p) {
    return vec2(vortex(p - vec2(0.5, 0.0)).x, vortex(p - vec2(0.0, 0.5)).y);
}

// Velocity: through the left face of a texel, in x, and through the lower one, in y.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(field, (p + 4 * size) % size, 0).xy;
}

float pressureAt(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(field, (p + size) % size, 0).x;
}

vec2 bilinear(sampler2D field, vec2 p) {
    vec2 base = floor(p - 0.5), t = p - 0.5 - base;
    ivec2 i = ivec2(base);
    vec2 a = at(field, i), b = at(field, i + ivec2(1, 0)), c = at(field, i + ivec2(0, 1)), d = at(field, i + ivec2(1, 1));
    vec2 low = a + t.x * (b - a), high = c + t.x * (d - c);
    return low + t.y * (high - low);
}

vec2 velocityAt(sampler2D field, vec2 p) {
    return vec2(bilinear(field, p + vec2(0.5, 0.0)).x, bilinear(field, p + vec2(0.0, 0.5)).y);
}

// Where what is at `p` was `span` of time ago; negative: where it will be. By the midpoint rule, in the velocity of the
// middle of the step.
vec2 departure(sampler2D drift, vec2 p, float span) {
    return p - span * velocityAt(drift, p - 0.5 * span * velocityAt(drift, p));
}

// Half of the step's viscosity along one direction, exactly on the grid: the heat kernel's weights e^(-2a) I_n(2a) by
// Miller's recurrence (Abramowitz and Stegun, 9.12), where a = viscosity t. The differences from the middle are summed, so
// that an even velocity stays as it is.
vec2 spreadAlong(sampler2D field, ivec2 p, ivec2 direction) {
    vec2 centre = at(field, p), sum = vec2(0.0);
    float a = 0.5 * dt * viscosity, further = 0.0, weight = 1e-30, total = 0.0;
    if (a < 1e-7) return centre;
    for (int n = int(ceil(5.0 * sqrt(2.0 * a))) + 3; n > 0; --n) {
        sum += weight * ((at(field, p - n * direction) - centre) + (at(field, p + n * direction) - centre));
        total += 2.0 * weight;
        float nearer = further + float(n) / a * weight;
        further = weight;
        weight = nearer;
    }
    return centre + sum / (total + weight);
}

vec2 gradient(sampler2D pressure, ivec2 p) {
    return pressureAt(pressure, p) - vec2(pressureAt(pressure, p - ivec2(1, 0)), pressureAt(pressure, p - ivec2(0, 1)));
}
