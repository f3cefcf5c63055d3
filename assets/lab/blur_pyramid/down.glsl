void mainImage(out vec4 half_size, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
#if METHOD == BOX
    half_size = at(iChannel0, uv, vec2(0.0));
#elif METHOD == DUAL
    // Bjorge, Bandwidth-Efficient Rendering, 2015.
    half_size = (4.0 * at(iChannel0, uv, vec2(0.0)) + at(iChannel0, uv, vec2(1.0, 1.0)) + at(iChannel0, uv, vec2(-1.0, 1.0))
        + at(iChannel0, uv, vec2(1.0, -1.0)) + at(iChannel0, uv, vec2(-1.0, -1.0))) / 8.0;
#else
    // Jimenez, Next Generation Post Processing in Call of Duty, 2014: thirteen reads.
    vec4 inner = at(iChannel0, uv, vec2(1.0, 1.0)) + at(iChannel0, uv, vec2(-1.0, 1.0)) + at(iChannel0, uv, vec2(1.0, -1.0))
        + at(iChannel0, uv, vec2(-1.0, -1.0));
    vec4 axes = at(iChannel0, uv, vec2(2.0, 0.0)) + at(iChannel0, uv, vec2(-2.0, 0.0)) + at(iChannel0, uv, vec2(0.0, 2.0))
        + at(iChannel0, uv, vec2(0.0, -2.0));
    vec4 corners = at(iChannel0, uv, vec2(2.0, 2.0)) + at(iChannel0, uv, vec2(-2.0, 2.0)) + at(iChannel0, uv, vec2(2.0, -2.0))
        + at(iChannel0, uv, vec2(-2.0, -2.0));
    half_size = 0.125 * (inner + at(iChannel0, uv, vec2(0.0))) + 0.0625 * axes + 0.03125 * corners;
#endif
}
