void mainImage(out vec4 c, in vec2 f) {
    bool u;
    float sum = 0.0;
    int i = 0;
    for (; i < 4; i++) {
        if (u) continue;
        sum += 1.0;
    }
    c = vec4(sum, float(i), 0.0, 1.0);
}
