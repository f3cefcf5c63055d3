#include "scene.glsl"

void mainImage(out vec4 mean, in vec2 fragCoord) {
    vec2 middle = vec2(0.0);
    for (int i = 0; i < SAMPLES; i++) middle += halton(i) / float(SAMPLES);
    mean = vec4(0.0);
    for (int i = 0; i < SAMPLES; i++) {
        vec2 at = fragCoord + halton(i) - middle - 0.5 * iResolution.xy;
        mean += vec4(scene(at * 192.0 / iResolution.y, float(iFrame)).rgb, 1.0) / float(SAMPLES);
    }
}
