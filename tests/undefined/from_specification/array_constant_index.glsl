void mainImage(out vec4 c, in vec2 f) {
    float a[4];
    a[0] = f.x;
    a[1] = f.y;
    a[3] = 1.0;
    c = vec4(a[0], a[1], a[2], a[3]);
}
