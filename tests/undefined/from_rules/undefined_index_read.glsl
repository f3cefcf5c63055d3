void mainImage(out vec4 c, in vec2 f) {
    int i;
    float a[3] = float[3](1.0, 2.0, 3.0);
    c = vec4(a[i], 0.0, 0.0, 1.0);
}
