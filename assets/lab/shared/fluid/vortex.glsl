// The first velocity of the fluids, and the sliders that all of them have.

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
