void mainImage(out vec4 colour, in vec2 fragCoord) {
    colour = vec4(texelFetch(iChannel0, ivec2(fragCoord), 0).xyz / vec3(320.0, 180.0, 1.0), 1.0);
}
