// A pass that reads itself never rests.
void mainImage(out vec4 texel, in vec2 fragCoord) {
    texel = 1.0 - texelFetch(iChannel0, ivec2(0), 0);
}
