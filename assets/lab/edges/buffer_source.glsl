// The normal and the depth, as they began.
void mainImage(out vec4 texel, in vec2 fragCoord) {
    texel = texelFetch(iChannel0, ivec2(fragCoord), 0);
}
