// What Buffer B needs to know of the frame before: x the distance of what was hit, y 1 + the time of that frame (0:
// there was none). Channel 0 is Buffer A.

void mainImage(out vec4 memory, in vec2 fragCoord) {
    memory = vec4(texelFetch(iChannel0, ivec2(fragCoord), 0).a, 1.0 + iTime, 0.0, 0.0);
}
