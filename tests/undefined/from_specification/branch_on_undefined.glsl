void mainImage(out vec4 c, in vec2 f) {
    bool u;
    float b = 0.0;
    float d = 1.0;
    if (u) b = 1.0;
    c = vec4(b, d, d, 1.0);
}
