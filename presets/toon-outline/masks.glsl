// x: the width mask, a hand that presses now more, now less. y: the clipping mask. Both close around the mesh.

void mainImage(out vec4 value, in vec2 fragCoord) {
    int page;
    vec2 uv = 6.28318531 * uvOfTexel(fragCoord, page);
    float press = 0.5 + 0.25 * sin(2.0 * uv.x + sin(uv.y)) + 0.25 * sin(3.0 * uv.y + 1.0);
    float torn = 0.5 + 0.3 * sin(3.0 * uv.x + 2.0 * sin(2.0 * uv.y)) * sin(2.0 * uv.y)
        + 0.2 * sin(5.0 * uv.x - 3.0 * uv.y);
    value = vec4(mix(0.45, 1.0, clamp(press, 0.0, 1.0)), clamp(torn, 0.0, 1.0), 0.0, 1.0);
}
