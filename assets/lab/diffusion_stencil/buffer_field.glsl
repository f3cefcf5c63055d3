float at(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(iChannel0, (p + size) % size, 0).x;
}

void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float u = at(p);
    // Differences from the middle, each exact or nearly so: u is not rounded with what is four times as large.
    float beside = (at(p + ivec2(1, 0)) - u) + (at(p - ivec2(1, 0)) - u) + (at(p + ivec2(0, 1)) - u) + (at(p - ivec2(0, 1)) - u);
#if STENCIL == 9
    float corners = (at(p + ivec2(1, 1)) - u) + (at(p + ivec2(1, -1)) - u) + (at(p + ivec2(-1, 1)) - u) + (at(p + ivec2(-1, -1)) - u);
    float laplacian = (4.0 * beside + corners) / 6.0;
#else
    float laplacian = beside;
#endif
    field = vec4(u + rate * laplacian, 0.0, 0.0, 1.0);
}
