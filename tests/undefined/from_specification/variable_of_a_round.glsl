void mainImage(out vec4 c, in vec2 f) {
    float sum = 0.0;
    for (int i = 0; i < int(f.x); i++) {
        float x;
        if (i == 0) x = 1.0;
        if (i <= 1) sum += x;
    }
    c = vec4(sum, 0.0, 0.0, 1.0);
}
