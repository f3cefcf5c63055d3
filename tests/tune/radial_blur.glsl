// A zoom blur of a pattern towards the middle.
#define SAMPLES 64
vec3 pattern(vec2 p) {
    vec2 cell = fract(4. * p) - .5;
    return (.5 + .5 * cos(vec3(0, 2, 4) + 3. * floor(4. * p.x) + iTime)) * smoothstep(.35, .3, length(cell));
}
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = (at - .5 * iResolution.xy) / iResolution.y;
    vec3 sum = vec3(0);
    for (int i = 0; i < SAMPLES; i++) sum += pattern(p * (1. - .3 * (float(i) + .5) / float(SAMPLES)));
    color = vec4(sum / float(SAMPLES), 1);
}
