// Each population comes from the texel behind it, where it has collided.
void mainImage(out vec4 corners, in vec2 fragCoord) {
    for (int i = 0; i < 4; ++i) {
        ivec2 from = ivec2(fragCoord) - ivec2(CORNERS_X[i], CORNERS_Y[i]);
        Cell f = cell(iChannel0, iChannel1, iChannel2, from);
        corners[i] = mix(f.corners[i], equilibrium(moments(f), 1.0 / 36.0, CORNERS_X, CORNERS_Y)[i], relaxed());
    }
}
