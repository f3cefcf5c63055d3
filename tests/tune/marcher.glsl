// A sphere and a box on a floor, marched, with AA * AA samples in each pixel.
#define AA 3
#define MAX_STEPS 128
#define SURF_DIST .0005
#define MAX_DIST 30.
float map(vec3 p) {
    vec3 box = abs(p - vec3(1.3, .5, 0)) - .45;
    return min(min(length(p - vec3(-.8, .8, 0)) - .8, length(max(box, 0.)) - .05), p.y);
}
vec3 normal(vec3 p) {
    vec2 e = vec2(.001, 0);
    return normalize(map(p) - vec3(map(p - e.xyy), map(p - e.yxy), map(p - e.yyx)));
}
vec3 render(vec2 uv) {
    float turn = .3 * iTime, t = 0.;
    vec3 eye = vec3(4. * sin(turn), 2., 4. * cos(turn)), ahead = normalize(vec3(0, .5, 0) - eye);
    vec3 across = normalize(cross(ahead, vec3(0, 1, 0))), up = cross(across, ahead);
    vec3 ray = normalize(uv.x * across + uv.y * up + 1.6 * ahead);
    for (int i = 0; i < MAX_STEPS; i++) {
        float d = map(eye + t * ray);
        if (d < SURF_DIST || t > MAX_DIST) break;
        t += d;
    }
    if (t > MAX_DIST) return vec3(.5, .6, .8) - .3 * ray.y;
    vec3 p = eye + t * ray, n = normal(p);
    float checks = mod(floor(p.x) + floor(p.z), 2.);
    return (.3 + .6 * max(dot(n, normalize(vec3(1, 2, .5))), 0.)) * mix(vec3(.9), vec3(.5, .3, .2), checks) * exp(-.04 * t);
}
void mainImage(out vec4 color, in vec2 at) {
    vec3 sum = vec3(0);
    for (int y = 0; y < AA; y++)
    for (int x = 0; x < AA; x++) {
        vec2 p = at + (vec2(x, y) + .5) / float(AA) - .5;
        sum += render((2. * p - iResolution.xy) / iResolution.y);
    }
    color = vec4(sqrt(sum / float(AA * AA)), 1);
}
