void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float x = pressureAt(iChannel1, p + ivec2(1, 0)) - pressureAt(iChannel1, p - ivec2(1, 0));
    float y = pressureAt(iChannel1, p + ivec2(0, 1)) - pressureAt(iChannel1, p - ivec2(0, 1));
    velocity = vec4(at(iChannel0, p) - 0.5 * vec2(x, y), 0.0, 1.0);
}
