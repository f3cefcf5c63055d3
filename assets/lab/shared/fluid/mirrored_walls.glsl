// Velocity. Beyond a wall lies the mirror image that makes the velocity on the wall the wall's own.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
#ifdef CAVITY
    ivec2 q = clamp(max(min(p, 2 * size - 1 - p), -1 - p), ivec2(0), size - 1);
    vec2 u = texelFetch(field, q, 0).xy;
    bool inside = all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, size));
    return inside ? u : vec2(p.y >= size.y ? 2.0 * lid : 0.0, 0.0) - u;
#else
    return texelFetch(field, (p + 4 * size) % size, 0).xy;
#endif
}
