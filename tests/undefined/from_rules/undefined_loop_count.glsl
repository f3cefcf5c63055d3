void mainImage(out vec4 c, in vec2 f) {
    int n;
    float sum = 0.0;
    for (int i = 0; i < n; i++) sum += 1.0;
    c = vec4(sum, 0.0, 0.0, 1.0);
}
