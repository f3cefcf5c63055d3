void mainImage(out vec4 c, in vec2 f) {
    mat2 m;
    m[0] = f;
    m[1].y = 1.0;
    c = vec4(inverse(m)[0], 0.0, 1.0);
}
