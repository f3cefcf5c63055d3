void mainImage(out vec4 c, in vec2 f) {
    float u;
    float a = 1.0;
    float b = 1.0;
    if (u > 1.0) a = 2.0; else b = 2.0;
    c = vec4(a, 0.0, 0.0, 1.0);
}
