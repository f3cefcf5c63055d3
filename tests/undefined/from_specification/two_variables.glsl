void mainImage(out vec4 c, in vec2 f) {
    float u;
    vec2 v;
    v.y = 0.5;
    if (f.x > 4.0) u = 1.0;
    if (f.y < 2.0) v.x = 0.0;
    c = vec4(u, 0.0 * v.x, v.y, 1.0);
}
