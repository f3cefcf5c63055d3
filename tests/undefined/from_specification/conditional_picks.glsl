void mainImage(out vec4 c, in vec2 f) {
    float u;
    float v = f.x > 2.0 ? u : 0.5;
    c = vec4(v, v, v, 1.0);
}
