#define JACOBI 20
// Pressure: each pixel solves the equation on a patch around it, from the pressure before.
void mainImage(out vec4 color, in vec2 at) {
    vec2 size = iResolution.xy;
    vec4 v = vec4(texture(iChannel0, (at + vec2(1, 0)) / size).x, texture(iChannel0, (at - vec2(1, 0)) / size).x,
                  texture(iChannel0, (at + vec2(0, 1)) / size).y, texture(iChannel0, (at - vec2(0, 1)) / size).y);
    float source = .5 * (v.x - v.y + v.z - v.w), here = texture(iChannel1, at / size).x;
    for (int i = 0; i < JACOBI; i++) {
        float far = 1. + mod(float(i), 3.), around = 0.;
        for (int k = 0; k < 4; k++) {
            vec2 by = far * vec2(ivec2(k == 0, k == 2) - ivec2(k == 1, k == 3));
            around += texture(iChannel1, (at + by) / size).x;
        }
        here = mix(here, .25 * (around - source), 2. / float(JACOBI + 2));
    }
    color = vec4(here, 0, 0, 1);
}
