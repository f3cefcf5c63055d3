// Occlusion of a field of bumps, by steps along the normal and around it.
const int AO_SAMPLES = 32;
float height(vec2 p) { return .25 * sin(3. * p.x + iTime) * sin(3. * p.y) + .1 * sin(9. * p.x) * sin(8. * p.y); }
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = 2. * at / iResolution.y;
    float here = height(p), open = 0.;
    for (int i = 0; i < AO_SAMPLES; i++) {
        float turn = 2.399963 * float(i), far = .5 * sqrt((float(i) + .5) / float(AO_SAMPLES));
        float rise = (height(p + far * vec2(cos(turn), sin(turn))) - here) / far;
        open += 1. - clamp(rise, 0., 1.);
    }
    color = vec4(vec3(.9, .85, .8) * open / float(AO_SAMPLES), 1);
}
