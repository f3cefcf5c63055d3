void mainImage(out vec4 c, in vec2 f) {
    vec4 v;
    v.wzx = vec3(f, 1.0);
    c = v.wyzx;
}
