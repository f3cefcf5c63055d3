void mainImage(out vec4 blur, in vec2 fragCoord) {
    blur = blurred(iChannel0, fragCoord, vec2(0.0, 1.0));
}
