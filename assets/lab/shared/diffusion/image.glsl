void mainImage(out vec4 colour, in vec2 fragCoord) {
    colour = vec4(vec3(texelFetch(iChannel0, ivec2(fragCoord), 0).x), 1.0);
}
