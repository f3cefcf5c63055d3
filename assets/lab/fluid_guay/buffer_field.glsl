void mainImage(out vec4 state, in vec2 fragCoord) {
#if METHOD == CHAIN
    state = stepped(iChannel1, fragCoord);
#elif METHOD == FORWARD_BACKWARD
    // The gradient of the density that is there already.
    ivec2 p = ivec2(fragCoord);
    vec2 gradient = 0.5 * vec2(at(iChannel2, p + ivec2(1, 0)).x - at(iChannel2, p - ivec2(1, 0)).x,
        at(iChannel2, p + ivec2(0, 1)).x - at(iChannel2, p - ivec2(0, 1)).x);
    state = vec4(moved(iChannel0, fragCoord, gradient), at(iChannel2, p).x, 1.0);
#else
    state = stepped(iChannel0, fragCoord);
#endif
}
