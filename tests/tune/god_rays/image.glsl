#define NUM_SAMPLES 100
#define DECAY .98
// Light is gathered on the way to the lamp.
void mainImage(out vec4 color, in vec2 at) {
    vec2 uv = at / iResolution.xy, by = (uv - .5) / float(NUM_SAMPLES);
    vec3 sum = vec3(0);
    float weight = 1.;
    for (int i = 0; i < NUM_SAMPLES; i++) {
        sum += weight * texture(iChannel0, uv).rgb;
        uv -= by;
        weight *= pow(DECAY, 100. / float(NUM_SAMPLES));
    }
    color = vec4(sum / float(NUM_SAMPLES) * 2., 1);
}
