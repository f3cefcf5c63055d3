// The pressure of the middle of the step times half of the step: both halves took the last one, and the second took in
// iChannel1 what was lacking to the sum. A gradient over two texels does not see what alternates from texel to texel: the
// fourth differences take it away, and leave of a wave of wave number k all but k^4 / 32.
void mainImage(out vec4 held, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float c = pressureAt(iChannel0, p), fourth = 12.0 * c;
    for (int axis = 0; axis < 2; ++axis) {
        ivec2 d = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        fourth -= 4.0 * (pressureAt(iChannel0, p + d) + pressureAt(iChannel0, p - d));
        fourth += pressureAt(iChannel0, p + 2 * d) + pressureAt(iChannel0, p - 2 * d);
    }
    held = vec4(c - fourth / 32.0 + 0.5 * pressureAt(iChannel1, p), 0.0, 0.0, 1.0);
}
