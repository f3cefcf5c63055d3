void mainImage(out vec4 c, in vec2 f) {
    float last;
    for (int i = 0; i < int(f.x); i++) last = float(i) * 0.1;
    c = vec4(last, 0.0, 0.0, 1.0);
}
