float pick(float x) {
    bool u;
    if (u) return 1.0;
    return x;
}
void mainImage(out vec4 c, in vec2 f) {
    c = vec4(pick(f.x), 0.0, 0.0, 1.0);
}
