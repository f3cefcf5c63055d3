// What a step does to a velocity u as a covector: along paths psi it becomes (grad psi)^T u(psi). Its circulation around
// a loop that moves with the flow is then the same, by Kelvin's theorem, and what a projection takes away is no more
// than a gradient. M. S. Nabizadeh, S. Wang, R. Ramamoorthi, A. Chern, "Covector fluids", ACM Transactions on Graphics
// 41 (4), 2022.

// Paths, less where they begin.
vec4 pathAt(sampler2D paths, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(paths, (p + size) % size, 0);
}

// The integral of a velocity from the middle of the texel on the left to that of this one, and from the one below,
// along where the paths lead to: into the past, or into the future.
vec2 pullBack(sampler2D field, sampler2D paths, ivec2 p, bool isPast) {
    vec4 all = pathAt(paths, p), allLeft = pathAt(paths, p - ivec2(1, 0)), allBelow = pathAt(paths, p - ivec2(0, 1));
    vec2 here = isPast ? all.xy : all.zw;
    vec2 left = isPast ? allLeft.xy : allLeft.zw, below = isPast ? allBelow.xy : allBelow.zw;
    vec2 u = velocityAt(field, vec2(p) + vec2(0.0, 0.5) + 0.5 * (left + here));
    vec2 v = velocityAt(field, vec2(p) + vec2(0.5, 0.0) + 0.5 * (below + here));
    return vec2(dot(vec2(1.0, 0.0) + here - left, u), dot(vec2(0.0, 1.0) + here - below, v));
}
