struct S { float t; vec3 n; bool hit; mat2 m; int id; };
S make(vec2 f) {
    S s;
    s.id = int(f.x);
    s.m = mat2(f.x);
    s.hit = f.x > 3.0;
    s.n.zyx = vec3(f, 0.5);
    s.t = f.y;
    return s;
}
void mainImage(out vec4 c, in vec2 f) {
    S s = make(f);
    c = vec4(s.n * s.t + s.m[0].xyy, s.hit ? 1.0 : float(s.id));
}
