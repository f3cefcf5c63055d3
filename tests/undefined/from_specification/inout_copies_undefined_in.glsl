void add(inout float total, float x) {
    total += x;
}
void mainImage(out vec4 c, in vec2 f) {
    float total;
    add(total, f.x);
    c = vec4(total, 0.0, 0.0, 1.0);
}
