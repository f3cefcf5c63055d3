// Light through a layer of density, in steps along the ray and towards the sun.
#define VOLUME_STEPS 64
#define LIGHT_STEPS 8
float density(vec3 p) {
    vec3 q = p + .3 * iTime * vec3(1, 0, 0);
    float d = sin(q.x) * sin(1.3 * q.y + q.z) * cos(q.z) + .5 * sin(2.3 * q.x + q.y) * sin(2.1 * q.z);
    return max(.6 * d + .2 - .3 * abs(p.y), 0.);
}
void mainImage(out vec4 color, in vec2 at) {
    vec3 ray = normalize(vec3((2. * at - iResolution.xy) / iResolution.y, 1.5));
    vec3 sun = normalize(vec3(.5, .8, .2)), sky = mix(vec3(.7, .8, .9), vec3(.2, .4, .7), .5 + .5 * ray.y), light = vec3(0);
    float through = 1., d = 8. / float(VOLUME_STEPS);
    for (int i = 0; i < VOLUME_STEPS; i++) {
        vec3 p = (float(i) + .5) * d * ray + vec3(0, 0, -3);
        float here = density(p), above = 0.;
        if (here <= 0.) continue;
        for (int k = 0; k < LIGHT_STEPS; k++) above += density(p + sun * (float(k) + .5) * 1.5 / float(LIGHT_STEPS));
        light += through * here * d * (vec3(.2, .25, .3) + vec3(1, .9, .7) * exp(-3. * above / float(LIGHT_STEPS)));
        through *= exp(-1.2 * here * d);
    }
    color = vec4(light + through * sky, 1);
}
