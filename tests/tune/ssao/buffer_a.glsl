// The distance of a landscape of waves, in a.
void mainImage(out vec4 color, in vec2 at) {
    vec3 ray = normalize(vec3((2. * at - iResolution.xy) / iResolution.y, -1.5) + vec3(0, -.6, 0)), p = vec3(0, 2, -iTime);
    float t = 0.;
    for (int i = 0; i < 60; i++) {
        vec3 q = p + t * ray;
        t += .6 * (q.y - .5 * sin(2. * q.x) * sin(2. * q.z));
    }
    color = vec4(.6 + .3 * cos(vec3(0, 1, 2) + p.z + t), min(t, 12.));
}
