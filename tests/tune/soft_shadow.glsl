// The light of a wide lamp past a ball: steps along each shadow ray.
const int SHADOW_STEPS = 96;
const float HARDNESS = 6.;
float map(vec3 p) { return length(p - vec3(.5 * sin(iTime), 1, 0)) - .5; }
float shadow(vec3 p, vec3 light) {
    float seen = 1.;
    for (int i = 1; i <= SHADOW_STEPS; i++) {
        float t = 4. * float(i) / float(SHADOW_STEPS);
        seen = min(seen, HARDNESS * map(p + t * light) / t);
    }
    return smoothstep(-.5, 1., seen);
}
void mainImage(out vec4 color, in vec2 at) {
    vec2 uv = (2. * at - iResolution.xy) / iResolution.y;
    vec3 p = vec3(2. * uv.x, 0, 2. * uv.y);
    color = vec4(vec3(.9, .8, .6) * (.15 + .85 * shadow(p, normalize(vec3(.6, 1, .3)))), 1);
}
