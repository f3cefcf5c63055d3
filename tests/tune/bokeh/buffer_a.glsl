// Lights of different sizes.
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = 5. * at / iResolution.y, cell = floor(p), f = fract(p) - .5;
    float size = .03 + .05 * fract(.37 * cell.x + .71 * cell.y);
    color = vec4((.5 + .5 * cos(cell.x + vec3(0, 2, 4) + iTime)) * 6. * smoothstep(size, .5 * size, length(f)) + .05, 1);
}
