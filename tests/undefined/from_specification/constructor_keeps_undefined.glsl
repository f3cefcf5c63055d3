struct S { vec2 a; vec3 b; };
void mainImage(out vec4 c, in vec2 f) {
    float u;
    S s = S(f, vec3(f.x, u, f.y));
    c = vec4(s.b.xy, s.a);
}
