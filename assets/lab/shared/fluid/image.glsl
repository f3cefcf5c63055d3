void mainImage(out vec4 colour, in vec2 fragCoord) {
    colour = vec4(0.5 + 0.5 * texelFetch(iChannel0, ivec2(fragCoord), 0).xy, 0.5, 1.0);
}
