float at(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(iChannel0, (p + size) % size, 0).x;
}

void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float u = at(p);
    float beside = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) + at(p - ivec2(0, 1));
#if STENCIL == 9
    float corners = at(p + ivec2(1, 1)) + at(p + ivec2(1, -1)) + at(p + ivec2(-1, 1)) + at(p + ivec2(-1, -1));
    float laplacian = (4.0 * beside + corners - 20.0 * u) / 6.0;
#else
    float laplacian = beside - 4.0 * u;
#endif
    field = vec4(u + rate * laplacian, 0.0, 0.0, 1.0);
}
