void mainImage(out vec4 c, in vec2 f) {
    float u;
    vec2 a = vec2(f.x, u);
    vec2 v = mix(a, vec2(1.0), bvec2(false, true));
    c = vec4(v, 0.0, 1.0);
}
