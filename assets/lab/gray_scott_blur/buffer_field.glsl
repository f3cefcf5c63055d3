void mainImage(out vec4 field, in vec2 fragCoord) {
    field = vec4(reacted(blurred(iChannel0, ivec2(fragCoord), ivec2(0, 1), false)), 0.0, 1.0);
}
