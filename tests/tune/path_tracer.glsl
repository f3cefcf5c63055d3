// Light bounced between three balls and a floor. Each pixel has samples of its own, by a hash of its place.
#define SPP 48
#define BOUNCES 4
uint seed;
float random() {
    seed = seed * 747796405u + 2891336453u;
    uint word = ((seed >> ((seed >> 28u) + 4u)) ^ seed) * 277803737u;
    return float((word >> 22u) ^ word) / 4294967295.;
}
float hit(vec3 o, vec3 d, vec4 ball) {
    vec3 q = o - ball.xyz;
    float b = dot(q, d), h = b * b - dot(q, q) + ball.w * ball.w;
    return h < 0. || -b - sqrt(h) < .001 ? 1e9 : -b - sqrt(h);
}
vec3 trace(vec3 o, vec3 d) {
    vec3 tint = vec3(1);
    for (int i = 0; i < BOUNCES; i++) {
        float t = d.y < 0. ? -o.y / d.y : 1e9;
        vec3 n = vec3(0, 1, 0), paint = vec3(.7);
        for (int k = 0; k < 3; k++) {
            vec4 ball = vec4(1.1 * float(k - 1), .5, .3 * sin(iTime + float(k)), .5);
            float s = hit(o, d, ball);
            if (s < t) { t = s; n = normalize(o + s * d - ball.xyz); paint = .5 + .4 * cos(vec3(0, 2, 4) + float(k)); }
        }
        if (t > 1e8) return tint * mix(vec3(1), vec3(.5, .7, 1), max(d.y, 0.));
        o += t * d + .001 * n;
        tint *= paint;
        float turn = 6.2832 * random(), z = 2. * random() - 1.;
        d = normalize(n + vec3(sqrt(1. - z * z) * vec2(cos(turn), sin(turn)), z) * .999);
    }
    return vec3(0);
}
void mainImage(out vec4 color, in vec2 at) {
    seed = uint(at.x) * 1973u + uint(at.y) * 9277u;
    vec3 sum = vec3(0);
    for (int i = 0; i < SPP; i++) {
        vec2 uv = (2. * (at + vec2(random(), random()) - .5) - iResolution.xy) / iResolution.y;
        sum += trace(vec3(0, 1, 4), normalize(vec3(uv, -2) + vec3(0, -.3, 0)));
    }
    color = vec4(sqrt(sum / float(SPP)), 1);
}
