void set(out vec2 v) { v = vec2(1.0); }
void mainImage(out vec4 c, in vec2 f) {
    vec2 a[2];
    set(a[1]);
    c = vec4(a[f.x < 1.0 ? 0 : 1], 0.0, 1.0);
}
