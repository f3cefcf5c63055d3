void mainImage(out vec4 colour, in vec2 fragCoord) {
    vec3 m = moments(cell(iChannel0, iChannel1, iChannel2, ivec2(fragCoord)));
    colour = vec4(0.5 + 0.5 * m.yz / dt, 0.5, 1.0);
}
