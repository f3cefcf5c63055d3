float early(float x) {
    float r;
    if (x < 2.0) return r;
    r = 1.0;
    return r;
}
void mainImage(out vec4 c, in vec2 f) {
    c = vec4(0.0, early(f.x), 0.0, 1.0);
}
