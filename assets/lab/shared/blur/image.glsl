// A texel of 1 is faint when it is blurred: shown 16 times as bright.
void mainImage(out vec4 colour, in vec2 fragCoord) {
    colour = 16.0 * texelFetch(iChannel0, ivec2(fragCoord), 0);
}
