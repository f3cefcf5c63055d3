void mainImage(out vec4 c, in vec2 f) {
    mat2 m;
    m[0][0] = f.x;
    m[1][0] = 0.5;
    vec2 p = m * f;
    vec2 q = f * m;
    c = vec4(p.x, transpose(m)[0], 1.0);
}
