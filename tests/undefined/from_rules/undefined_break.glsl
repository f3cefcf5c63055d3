void mainImage(out vec4 c, in vec2 f) {
    bool u;
    float sum = 0.0;
    for (int i = 0; i < 4; i++) {
        if (u) break;
        sum += 1.0;
    }
    c = vec4(sum, 0.0, 0.0, 1.0);
}
