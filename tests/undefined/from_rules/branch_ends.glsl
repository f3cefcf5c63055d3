void mainImage(out vec4 c, in vec2 f) {
    float u;
    float a = 1.0;
    if (u > 1.0) a = 2.0;
    a = f.x;
    c = vec4(a, 0.0, 0.0, 1.0);
}
