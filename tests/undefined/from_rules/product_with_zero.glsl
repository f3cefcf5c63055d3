void mainImage(out vec4 c, in vec2 f) {
    float u;
    c = vec4(0.0 * u, 0.0, 0.0, 1.0);
}
