// The waves of the reaction, for the next step; the third component says that there are some.
void mainImage(out vec4 history, in vec2 fragCoord) {
    history = vec4(texelFetch(iChannel0, ivec2(fragCoord), 0).zw, 1.0, 1.0);
}
