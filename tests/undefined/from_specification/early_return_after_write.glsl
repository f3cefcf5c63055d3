float early(float x) {
    float r;
    if (x < 2.0) { r = 0.25; return r; }
    if (x < 4.0) return 0.5;
    r = 1.0;
    return r;
}
void mainImage(out vec4 c, in vec2 f) {
    c = vec4(0.0, early(f.x), 0.0, 1.0);
}
