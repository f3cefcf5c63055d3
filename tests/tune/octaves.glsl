// Octaves of value noise.
#define OCTAVES 9
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 437.585); }
float noise(vec2 p) {
    vec2 i = floor(p), f = p - i;
    f *= f * (3. - 2. * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + 1.), f.x), f.y);
}
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = 3. * at / iResolution.y + .1 * iTime;
    float sum = 0., gain = .5;
    for (int i = 0; i < OCTAVES; i++) {
        sum += gain * noise(p);
        p = mat2(1.6, 1.2, -1.2, 1.6) * p;
        gain *= .45;
    }
    color = vec4(mix(vec3(.2, .4, .8), vec3(1), smoothstep(.25, .75, sum)), 1);
}
