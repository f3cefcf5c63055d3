void mainImage(out vec4 c, in vec2 f) {
    vec4 v;
    v.bgr = vec3(f, 1.0);
    vec3 w = v.zyx;
    c = vec4(w.xx, w.yz);
}
