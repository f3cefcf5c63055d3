struct S { float a; vec2 b; };
void mainImage(out vec4 c, in vec2 f) {
    float u;
    S s = S(1.0, f);
    if (u > 1.0) s.b.x = 0.0;
    c = vec4(s.a, s.b.y, 0.0, 1.0);
}
