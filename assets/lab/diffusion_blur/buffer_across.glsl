void mainImage(out vec4 field, in vec2 fragCoord) {
    field = vec4(blurred(iChannel0, ivec2(fragCoord), ivec2(1, 0)), 0.0, 0.0, 1.0);
}
