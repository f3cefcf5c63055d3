void mainImage(out vec4 c, in vec2 f) {
    vec3 v;
    v.x = f.x;
    v.y = f.y;
    mat3 m;
    m[0].xy = f;
    m[1].xy = f.yx;
    c = vec4(vec2(v), mat2(m)[1]);
}
