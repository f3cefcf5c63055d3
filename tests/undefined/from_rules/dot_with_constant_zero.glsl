void mainImage(out vec4 c, in vec2 f) {
    vec2 v;
    v.x = f.x;
    c = vec4(dot(v, vec2(1.0, 0.0)), 0.0, 0.0, 1.0);
}
