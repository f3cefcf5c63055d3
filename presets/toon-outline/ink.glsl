// The outline's texture: ink that dries unevenly.

void mainImage(out vec4 value, in vec2 fragCoord) {
    int page;
    vec2 uv = 6.28318531 * uvOfTexel(fragCoord, page);
    float dry = sin(7.0 * uv.x + 3.0 * sin(2.0 * uv.y)) * sin(5.0 * uv.y + 2.0 * sin(3.0 * uv.x));
    value = vec4(mix(vec3(1.0), vec3(0.55, 0.50, 0.72), 0.5 + 0.5 * dry), 1.0);
}
