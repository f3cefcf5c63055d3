void mainImage(out vec4 corrected, in vec2 fragCoord) {
    vec2 before = at(iChannel0, ivec2(fragCoord));
    vec2 back = bilinear(iChannel1, origin(fragCoord, -turn));
    corrected = vec4(before + 0.5 * (before - back), 0.0, 1.0);
}
