struct Hit { float t; vec3 n; };
void fill(out Hit h) {
    h.n = vec3(1.0);
}
void mainImage(out vec4 c, in vec2 f) {
    Hit h;
    h.t = f.x;
    fill(h);
    c = vec4(h.n.xy, h.t, 1.0);
}
