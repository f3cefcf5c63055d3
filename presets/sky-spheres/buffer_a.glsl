// What the sky needs of the sliders, computed once and not for each of six million texels: the numbers of Sky, and the light
// on the ground.

float zenith(vec4 cubed, vec4 squared, vec4 plain) {
    float s = radians(90.0 - sunHeight), t = turbidity;
    vec4 powers = vec4(s * s * s, s * s, s, 1.0);
    return t * t * dot(powers, cubed) + t * dot(powers, squared) + dot(powers, plain);
}

// Tables of the paper's appendix A.2.
Sky skyOfSliders() {
    float t = turbidity, s = radians(90.0 - sunHeight);
    float chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * s);
    Sky sky;
    sky.abcd[0] = vec4(0.1787, -0.3554, -0.0227, 0.1206) * t + vec4(-1.4630, 0.4275, 5.3251, -2.5771);
    sky.abcd[1] = vec4(-0.0193, -0.0665, -0.0004, -0.0641) * t + vec4(-0.2592, 0.0008, 0.2125, -0.8989);
    sky.abcd[2] = vec4(-0.0167, -0.0950, -0.0079, -0.0441) * t + vec4(-0.2608, 0.0092, 0.2102, -1.6537);
    vec3 e = vec3(-0.0670, -0.0033, -0.0109) * t + vec3(0.3703, 0.0452, 0.0529);
    vec3 atZenith = vec3((4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192,
                         zenith(vec4(0.00166, -0.00375, 0.00209, 0.0), vec4(-0.02903, 0.06377, -0.03202, 0.00394),
                                vec4(0.11693, -0.21196, 0.06052, 0.25886)),
                         zenith(vec4(0.00275, -0.00610, 0.00317, 0.0), vec4(-0.04214, 0.08970, -0.04153, 0.00516),
                                vec4(0.15346, -0.26756, 0.06670, 0.26688)));
    for (int i = 0; i < 3; i++) sky.rest[i] = vec2(e[i], atZenith[i] / perez(sky.abcd[i], e[i], 1.0, s));
    return sky;
}

// Light on level ground: the sun's, and the mean of the sky in four directions halfway up and of the zenith.
vec3 groundLight(Sky sky) {
    vec3 sum = clearSky(sky, vec3(0.0, 1.0, 0.0));
    for (int i = 0; i < 4; i++) {
        float turn = 0.5 * PI * float(i) + 0.4;
        sum += clearSky(sky, normalize(vec3(cos(turn), 0.8, sin(turn))));
    }
    vec3 fromSky = mix(0.2 * sum, cloudLight(sky, vec3(0.0, 1.0, 0.0)), 0.8 * clouds);
    return fromSky + vec3(1.3, 1.05, 0.7) * sunDirection().y;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Sky sky = skyOfSliders();
    int i = int(fragCoord.x);
    if (i < 3) fragColor = sky.abcd[i];
    else if (i < 6) fragColor = vec4(sky.rest[i - 3], 0.0, 0.0);
    else fragColor = vec4(groundLight(sky), 1.0);
}
