#define SSAO_SAMPLES 48
#define RADIUS .5
// Occlusion by what is nearer in the picture.
void mainImage(out vec4 color, in vec2 at) {
    vec4 here = texture(iChannel0, at / iResolution.xy);
    float hidden = 0., reach = RADIUS * iResolution.y / here.a;
    for (int i = 0; i < SSAO_SAMPLES; i++) {
        float turn = 2.399963 * float(i), far = reach * sqrt((float(i) + .5) / float(SSAO_SAMPLES));
        float there = texture(iChannel0, (at + far * vec2(cos(turn), sin(turn))) / iResolution.xy).a;
        hidden += smoothstep(0., .4, here.a - there) * smoothstep(1.5, .7, here.a - there);
    }
    color = vec4(here.rgb * (1. - hidden / float(SSAO_SAMPLES)) * exp(-.1 * here.a), 1);
}
