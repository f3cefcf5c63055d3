struct Hit { float t; vec3 n; };
void fill(inout Hit h) {
    h.n = vec3(h.t);
}
void mainImage(out vec4 c, in vec2 f) {
    Hit h;
    h.t = f.x;
    fill(h);
    c = vec4(h.n, h.t);
}
