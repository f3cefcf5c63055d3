void mainImage(out vec4 divergence, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float x = at(iChannel0, p + ivec2(1, 0)).x - at(iChannel0, p - ivec2(1, 0)).x;
    float y = at(iChannel0, p + ivec2(0, 1)).y - at(iChannel0, p - ivec2(0, 1)).y;
    divergence = vec4(0.5 * (x + y), 0.0, 0.0, 1.0);
}
