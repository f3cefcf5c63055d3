void mainImage(out vec4 c, in vec2 f) {
    vec3 v;
    v.yz = f;
    vec3 w = cross(v, vec3(1.0, 2.0, 3.0));
    c = vec4(w.x, w.y, 0.0, 1.0);
}
