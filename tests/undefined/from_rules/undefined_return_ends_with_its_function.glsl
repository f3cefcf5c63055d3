float g;
void pick(float x) {
    bool u;
    if (u) return;
    g = x;
}
void mainImage(out vec4 c, in vec2 f) {
    pick(f.x);
    g = 1.0;
    c = vec4(g, 0.0, 0.0, 1.0);
}
