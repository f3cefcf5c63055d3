void mainImage(out vec4 c, in vec2 f) {
    float a[4];
    for (int i = 0; i < 3; i++) a[i] = float(i);
    c = vec4(a[int(f.x) % 4], 0.0, 0.0, 1.0);
}
