// Balls that melt together: each pixel sums the field of all, and the surface is found by steps.
#define BALLS 12
#define STEPS 80
const float STEP = .05;
float field(vec3 p) {
    float sum = 0.;
    for (int i = 0; i < BALLS; i++) {
        vec3 q = p - 1.2 * sin(vec3(1.1, 1.7, 2.3) * float(i) + .4 * iTime * vec3(1, .7, .5));
        sum += .08 / dot(q, q);
    }
    return sum;
}
void mainImage(out vec4 color, in vec2 at) {
    vec3 ray = normalize(vec3((2. * at - iResolution.xy) / iResolution.y, -2)), p = vec3(0, 0, 4) + 2. * ray;
    float most = 0.;
    for (int i = 0; i < STEPS; i++) {
        float here = field(p);
        most = max(most, here);
        if (here > 1.) break;
        p += STEP * ray;
    }
    color = vec4(most > 1. ? .5 + .4 * sin(3. * p) : vec3(.1, .12, .2) * (.5 + most), 1);
}
