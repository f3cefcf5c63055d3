void mainImage(out vec4 c, in vec2 f) {
    vec2 a[4];
    for (int i = 0; i < 4; i++) {
        a[i].x = float(i);
        a[3 - i].y = f.y;
    }
    vec2 sum = vec2(0.0);
    for (int i = 3; i >= 0; i--) sum += a[i];
    c = vec4(sum, a[int(f.x) & 3]);
}
