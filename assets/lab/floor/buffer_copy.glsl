void mainImage(out vec4 texel, in vec2 fragCoord) {
    texel = texelFetch(iChannel0, ivec2(fragCoord), 0);
}
