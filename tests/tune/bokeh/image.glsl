#define BLUR_SAMPLES 150
// Samples of a disc, in the order of a sunflower.
void mainImage(out vec4 color, in vec2 at) {
    vec3 sum = vec3(0);
    for (int i = 0; i < BLUR_SAMPLES; i++) {
        float turn = 2.399963 * float(i), far = .06 * iResolution.y * sqrt((float(i) + .5) / float(BLUR_SAMPLES));
        sum += texture(iChannel0, (at + far * vec2(cos(turn), sin(turn))) / iResolution.xy).rgb;
    }
    color = vec4(1. - exp(-2. * sum / float(BLUR_SAMPLES)), 1);
}
