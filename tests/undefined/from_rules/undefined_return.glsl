void mainImage(out vec4 c, in vec2 f) {
    float u;
    c = vec4(1.0);
    if (u > 1.0) return;
    c.x = f.x;
}
