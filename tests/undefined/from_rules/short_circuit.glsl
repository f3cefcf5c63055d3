void mainImage(out vec4 c, in vec2 f) {
    bool u;
    bool b = f.x > 0.0 || u;
    c = vec4(b, false, false, true);
}
