// Pressure, without a gradient at a wall.
float pressureAt(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
#ifdef CAVITY
    return texelFetch(field, clamp(p, ivec2(0), size - 1), 0).x;
#else
    return texelFetch(field, (p + size) % size, 0).x;
#endif
}
