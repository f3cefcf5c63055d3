// The nearest of moving points: cells within REACH are looked at.
#define REACH 3
vec2 hash(vec2 p) { return fract(sin(vec2(dot(p, vec2(127.1, 311.7)), dot(p, vec2(269.5, 183.3)))) * 43.758); }
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = 6. * at / iResolution.y, cell = floor(p);
    float nearest = 9.;
    for (int y = -REACH; y <= REACH; y++)
    for (int x = -REACH; x <= REACH; x++) {
        vec2 there = cell + vec2(x, y);
        nearest = min(nearest, length(there + .5 + .45 * sin(iTime + 6.28 * hash(there)) - p));
    }
    color = vec4(mix(vec3(.1, .2, .4), vec3(1, .9, .7), nearest), 1);
}
