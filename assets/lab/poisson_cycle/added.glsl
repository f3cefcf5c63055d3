// (p, f) of iChannel0 with the coarser grid's p of iChannel1 added, bilinear between texel centres.
float coarse(ivec2 p) {
    ivec2 size = textureSize(iChannel1, 0);
#ifdef CAVITY
    return texelFetch(iChannel1, clamp(p, ivec2(0), size - 1), 0).x;
#else
    return texelFetch(iChannel1, (p + size) % size, 0).x;
#endif
}

void mainImage(out vec4 added, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), c = p / 2, d = 2 * (p & 1) - 1;
    float near = 0.75 * coarse(c) + 0.25 * coarse(c + ivec2(d.x, 0));
    float far = 0.75 * coarse(c + ivec2(0, d.y)) + 0.25 * coarse(c + d);
    vec2 w = texelFetch(iChannel0, p, 0).xy;
    added = vec4(w.x + mix(near, far, 0.25), w.y, 0.0, 1.0);
}
