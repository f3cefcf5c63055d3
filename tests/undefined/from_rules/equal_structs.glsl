struct S { vec2 v; float t; };
void mainImage(out vec4 c, in vec2 f) {
    S a;
    a.v.x = f.x; a.t = 1.0;
    c = vec4(a == S(f, 1.0) ? 1.0 : 0.0, 0.0, 0.0, 1.0);
}
