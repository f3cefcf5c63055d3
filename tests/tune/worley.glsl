// Sums of cellular noise.
const int LAYERS = 7;
vec2 hash(vec2 p) { return fract(sin(vec2(dot(p, vec2(127.1, 311.7)), dot(p, vec2(269.5, 183.3)))) * 43.758); }
float worley(vec2 p) {
    vec2 cell = floor(p);
    float nearest = 1.;
    for (int i = 0; i < 9; i++) {
        vec2 there = cell + vec2(i % 3 - 1, i / 3 - 1);
        nearest = min(nearest, length(there + hash(there) - p));
    }
    return nearest;
}
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = 2. * at / iResolution.y + .1 * iTime;
    float sum = 0., gain = .5;
    for (int i = 0; i < LAYERS; i++, p *= 2.1, gain *= .4) sum += gain * worley(p);
    color = vec4(mix(vec3(.1, .05, 0), vec3(1, .8, .5), 1.4 * sum), 1);
}
