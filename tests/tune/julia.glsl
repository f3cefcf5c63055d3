// A Julia set with samples on a grid in each pixel.
const int GRID = 5;
const int MAX_ITER = 96;
vec3 julia(vec2 z) {
    vec2 c = .75 * vec2(cos(.2 * iTime), sin(.2 * iTime));
    float n = 0.;
    for (int i = 0; i < MAX_ITER && dot(z, z) < 16.; i++) {
        z = vec2(z.x * z.x - z.y * z.y, 2. * z.x * z.y) + c;
        n += 1.;
    }
    return .5 + .5 * cos(vec3(3, 4, 5) + .2 * n);
}
void mainImage(out vec4 color, in vec2 at) {
    vec3 sum = vec3(0);
    for (int i = 0; i < GRID * GRID; i++) {
        vec2 by = (vec2(i % GRID, i / GRID) + .5) / float(GRID) - .5;
        sum += julia((2. * (at + by) - iResolution.xy) / iResolution.y * 1.3);
    }
    color = vec4(sum / float(GRID * GRID), 1);
}
