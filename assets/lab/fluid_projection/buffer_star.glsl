void mainImage(out vec4 star, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 u = at(iChannel0, p);
#if METHOD == SEMI_LAGRANGIAN
    star = vec4(bilinear(iChannel1, fragCoord - dt * u), 0.0, 1.0);
#else
    vec2 back = bilinear(iChannel2, fragCoord + dt * u);
    star = vec4(at(iChannel2, p) + 0.5 * (at(iChannel1, p) - back), 0.0, 1.0);
#endif
}
