void mainImage(out vec4 c, in vec2 f) {
    float u;
    if (f.x > 4.0) u = 0.0;
    if (u > 1.0) discard;
    c = vec4(1.0);
}
