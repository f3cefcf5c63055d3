// Relief mapping of bricks: steps through the depth, and halvings of the last one.
#define RELIEF_STEPS 96
#define HALVINGS 8
float depth(vec2 p) {
    p.x += .5 * mod(floor(p.y), 2.);
    vec2 f = abs(fract(p) - .5) * vec2(1, .9);
    return smoothstep(.38, .46, max(f.x, f.y)) * .25;
}
void mainImage(out vec4 color, in vec2 at) {
    vec2 uv = (2. * at - iResolution.xy) / iResolution.y;
    vec3 ray = normalize(vec3(uv, 1.2) + vec3(.8 * sin(.5 * iTime), .4, 0)), p = vec3(3. * uv + .2 * iTime, 0);
    ray /= ray.z;
    float d = .25 / float(RELIEF_STEPS), z = 0.;
    for (int i = 0; i < RELIEF_STEPS && z < depth(p.xy + z * ray.xy); i++) z += d;
    for (int i = 0; i < HALVINGS; i++) {
        d *= .5;
        z += z < depth(p.xy + z * ray.xy) ? d : -d;
    }
    vec2 q = p.xy + z * ray.xy, cell = floor(q + vec2(.5 * mod(floor(q.y), 2.), 0));
    float light = 1. - 3. * z - .4 * step(.01, depth(q + .08) - z);
    color = vec4(mix(vec3(.7, .3, .2), vec3(.6), 4. * z) * (.8 + .2 * fract(.37 * cell.x + .61 * cell.y)) * light, 1);
}
