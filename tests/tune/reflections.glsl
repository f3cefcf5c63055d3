// Mirrors between mirrors: a ray is followed for as many reflections as the depth says.
#define DEPTH 12
#define STEPS 64
float map(vec3 p) {
    vec3 cell = vec3(mod(p.x + 1.5, 3.) - 1.5, p.y, mod(p.z + 1.5, 3.) - 1.5);
    return min(length(cell - vec3(0, .7 + .2 * sin(iTime), 0)) - .7, p.y);
}
void mainImage(out vec4 color, in vec2 at) {
    vec3 ray = normalize(vec3((2. * at - iResolution.xy) / iResolution.y, -1.5)), o = vec3(.7, 1.2, 4), sum = vec3(0);
    float strength = 1.;
    for (int k = 0; k < DEPTH; k++) {
        float t = .02;
        for (int i = 0; i < STEPS; i++) {
            float d = map(o + t * ray);
            if (d < .001 || t > 20.) break;
            t += d;
        }
        vec3 sky = mix(vec3(.9, .8, .7), vec3(.2, .4, .8), max(ray.y, 0.));
        if (t > 20.) { sum += strength * sky; break; }
        o += t * ray;
        vec2 e = vec2(.001, 0);
        vec3 n = normalize(map(o) - vec3(map(o - e.xyy), map(o - e.yxy), map(o - e.yyx)));
        sum += strength * .3 * (.5 + .5 * n.y) * (o.y < .01 ? vec3(.6, .5, .4) : vec3(.8, .3, .3));
        strength *= .6;
        ray = reflect(ray, n);
    }
    color = vec4(sum, 1);
}
