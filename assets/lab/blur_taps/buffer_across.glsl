void mainImage(out vec4 blur, in vec2 fragCoord) {
    blur = blurred(iChannel0, fragCoord, vec2(1.0, 0.0));
}
