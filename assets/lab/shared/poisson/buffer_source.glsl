// Drawn in every frame, as a source that changes is.
void mainImage(out vec4 source, in vec2 fragCoord) {
    source = texelFetch(iChannel0, ivec2(fragCoord), 0);
}
