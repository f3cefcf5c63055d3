void mainImage(out vec4 c, in vec2 f) {
    int i;
    float a[3] = float[3](1.0, 2.0, 3.0);
    a[i & 1] = f.x;
    c = vec4(a[2], 0.0, 0.0, 1.0);
}
