void mainImage(out vec4 c, in vec2 f) {
    int i;
    vec3 v = vec3(f, 1.0);
    c = vec4(v[i], v.y, 0.0, 1.0);
}
