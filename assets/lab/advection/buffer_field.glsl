void mainImage(out vec4 field, in vec2 fragCoord) {
    vec2 from = origin(fragCoord, turn);
#if METHOD == BILINEAR
    vec2 value = bilinear(iChannel0, from);
#elif METHOD == CUBIC
    vec2 value = cubic(iChannel0, from);
#elif METHOD == BFECC
    vec2 value = bilinear(iChannel2, from);
#else
    // MacCormack after Selle et al. 2008: the error of there and back, halved, where the step arrives.
    ivec2 p = ivec2(fragCoord);
    vec2 back = bilinear(iChannel1, origin(fragCoord, -turn));
    vec2 value = at(iChannel1, p) + 0.5 * (at(iChannel0, p) - back);
#if METHOD == CLAMPED
    ivec2 i = ivec2(floor(from - 0.5));
    vec2 a = at(iChannel0, i), b = at(iChannel0, i + ivec2(1, 0));
    vec2 c = at(iChannel0, i + ivec2(0, 1)), d = at(iChannel0, i + ivec2(1, 1));
    value = clamp(value, min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
#endif
#endif
    field = vec4(value, 0.0, 1.0);
}
