vec2 at(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    vec2 w = texelFetch(iChannel0, (p + size) % size, 0).xy;
#if SPLIT == 1
    w = reacted(w);
#endif
    return w;
}

void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 w = at(p);
    vec2 beside = (at(p + ivec2(1, 0)) - w) + (at(p - ivec2(1, 0)) - w) + (at(p + ivec2(0, 1)) - w) + (at(p - ivec2(0, 1)) - w);
#if STENCIL == 9
    vec2 corners = (at(p + ivec2(1, 1)) - w) + (at(p + ivec2(1, -1)) - w) + (at(p + ivec2(-1, 1)) - w) + (at(p + ivec2(-1, -1)) - w);
    vec2 laplacian = (4.0 * beside + corners) / 6.0;
#else
    vec2 laplacian = beside;
#endif
#if SPLIT == 1
    field = vec4(reacted(w + dt * DIFFUSION * laplacian), 0.0, 1.0);
#else
    field = vec4(w + dt * (DIFFUSION * laplacian + reaction(w)), 0.0, 1.0);
#endif
}
