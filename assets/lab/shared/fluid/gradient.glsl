vec2 gradient(sampler2D pressure, ivec2 p) {
    float x = pressureAt(pressure, p + ivec2(1, 0)) - pressureAt(pressure, p - ivec2(1, 0));
    float y = pressureAt(pressure, p + ivec2(0, 1)) - pressureAt(pressure, p - ivec2(0, 1));
    return 0.5 * vec2(x, y);
}
