struct S { float t; vec3 n; };
S make(float x) {
    S s;
    s.t = x;
    return s;
}
void mainImage(out vec4 c, in vec2 f) {
    S s = make(f.x);
    c = vec4(s.n, 1.0);
}
