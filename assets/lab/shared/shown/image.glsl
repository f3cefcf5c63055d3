void mainImage(out vec4 colour, in vec2 fragCoord) {
    colour = texelFetch(iChannel0, ivec2(fragCoord), 0);
}
