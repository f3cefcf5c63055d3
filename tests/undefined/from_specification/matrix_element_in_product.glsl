void mainImage(out vec4 c, in vec2 f) {
    mat2 m;
    m[0] = f;
    m[1][0] = 0.5;
    vec2 p = m * f;
    c = vec4(p.y, p.x, 0.0, 1.0);
}
