void divide(float a, float b, out float r) {
    if (b < 2.0) r = a / b;
}
void mainImage(out vec4 c, in vec2 f) {
    float r = 1.0;
    divide(f.x, f.y, r);
    c = vec4(r, 0.0, 0.0, 1.0);
}
