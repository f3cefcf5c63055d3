void mainImage(out vec4 c, in vec2 f) {
    bool u;
    float sum = 0.0;
    do { sum += 1.0; } while (u);
    c = vec4(sum, 0.0, 0.0, 1.0);
}
