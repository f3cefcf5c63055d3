void mainImage(out vec4 c, in vec2 f) {
    float u;
    float w = u * 2.0 + 1.0;
    vec2 v = vec2(w, f.x);
    v.x = f.y;
    if (w > 1.0) w = 0.0;
    c = vec4(v, 0.0, 1.0);
}
