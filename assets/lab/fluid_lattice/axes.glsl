// Each population comes from the texel behind it, where it has collided.
void mainImage(out vec4 axes, in vec2 fragCoord) {
    for (int i = 0; i < 4; ++i) {
        ivec2 from = ivec2(fragCoord) - ivec2(AXES_X[i], AXES_Y[i]);
        Cell f = cell(iChannel0, iChannel1, iChannel2, from);
        axes[i] = mix(f.axes[i], equilibrium(moments(f), 1.0 / 9.0, AXES_X, AXES_Y)[i], relaxed());
    }
}
