void set(out vec2 v) { v = vec2(1.0); }
void mainImage(out vec4 c, in vec2 f) {
    vec3 v;
    set(v.yx);
    c = vec4(v, 1.0);
}
