float half_plane(float x) {
    if (x < 4.0) return 1.0;
}
void mainImage(out vec4 c, in vec2 f) {
    c = vec4(half_plane(f.x), 0.0, 0.0, 1.0);
}
