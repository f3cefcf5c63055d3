void mainImage(out vec4 full_size, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
#if METHOD == BOX
    full_size = at(iChannel0, uv, vec2(0.0));
#elif METHOD == DUAL
    vec4 axes = at(iChannel0, uv, vec2(1.0, 0.0)) + at(iChannel0, uv, vec2(-1.0, 0.0)) + at(iChannel0, uv, vec2(0.0, 1.0))
        + at(iChannel0, uv, vec2(0.0, -1.0));
    vec4 corners = at(iChannel0, uv, vec2(0.5, 0.5)) + at(iChannel0, uv, vec2(-0.5, 0.5)) + at(iChannel0, uv, vec2(0.5, -0.5))
        + at(iChannel0, uv, vec2(-0.5, -0.5));
    full_size = (axes + 2.0 * corners) / 12.0;
#else
    vec4 axes = at(iChannel0, uv, vec2(1.0, 0.0)) + at(iChannel0, uv, vec2(-1.0, 0.0)) + at(iChannel0, uv, vec2(0.0, 1.0))
        + at(iChannel0, uv, vec2(0.0, -1.0));
    vec4 corners = at(iChannel0, uv, vec2(1.0, 1.0)) + at(iChannel0, uv, vec2(-1.0, 1.0)) + at(iChannel0, uv, vec2(1.0, -1.0))
        + at(iChannel0, uv, vec2(-1.0, -1.0));
    full_size = (4.0 * at(iChannel0, uv, vec2(0.0)) + 2.0 * axes + corners) / 16.0;
#endif
}
