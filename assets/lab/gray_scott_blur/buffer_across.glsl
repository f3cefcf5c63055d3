void mainImage(out vec4 across, in vec2 fragCoord) {
    across = vec4(blurred(iChannel0, ivec2(fragCoord), ivec2(1, 0), true), 0.0, 1.0);
}
