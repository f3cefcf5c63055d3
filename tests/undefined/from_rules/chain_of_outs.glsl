void inner(float x, out vec2 r) { r.x = x; if (x > 4.0) r.y = 1.0; }
void outer(float x, out vec2 r) { inner(x, r); }
void mainImage(out vec4 c, in vec2 f) {
    vec2 r = vec2(0.0);
    outer(f.x, r);
    c = vec4(r, 0.0, 1.0);
}
