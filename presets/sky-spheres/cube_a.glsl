// The sky in all directions. It depends on the sliders alone, so it is drawn once and kept while they stay.

// Light that a cloud sends: of the sky, and of the sun that shines through it.
vec3 cloudLight(vec3 direction) {
    float towardsSun = max(dot(direction, sunDirection()), 0.0);
    return clearSky(vec3(0.0, 1.0, 0.0)) * 1.6 + vec3(0.42, 0.36, 0.3) * (0.35 + pow(towardsSun, 6.0));
}

// Clouds in a layer, as thick as noise in octaves says.
vec3 withClouds(vec3 sky, vec3 direction) {
    if (direction.y < 0.02 || clouds == 0.0) return sky;
    vec3 at = vec3(direction.xz / (direction.y + 0.12), 0.0) * 1.7;
    float thick = 0.0, share = 0.5;
    for (int octave = 0; octave < 6; octave++) {
        thick += share * noise(at + 17.0 * float(octave));
        at *= 2.03;
        share *= 0.5;
    }
    float cover = smoothstep(1.0 - clouds, 1.25 - 0.6 * clouds, thick + 0.25);
    return mix(sky, cloudLight(direction), cover * smoothstep(0.02, 0.2, direction.y));
}

// Light on level ground: the sun's, and the mean of the sky in four directions halfway up and of the zenith.
vec3 groundLight() {
    vec3 sum = clearSky(vec3(0.0, 1.0, 0.0));
    for (int i = 0; i < 4; i++) {
        float turn = 0.5 * PI * float(i) + 0.4;
        sum += clearSky(normalize(vec3(cos(turn), 0.8, sin(turn))));
    }
    return mix(0.2 * sum, cloudLight(vec3(0.0, 1.0, 0.0)), 0.8 * clouds) + vec3(1.3, 1.05, 0.7) * sunDirection().y;
}

void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) {
    vec3 sky = withClouds(clearSky(rayDir), rayDir);
    // The sun is 0.53 degrees wide, and here not brighter than half floats can average.
    float toSun = dot(rayDir, sunDirection());
    sky += 200.0 * vec3(1.0, 0.85, 0.6) * smoothstep(cos(radians(0.45)), cos(radians(0.2)), toSun);
    vec3 ground = vec3(0.0);
    if (rayDir.y < 0.01) ground = GROUND * groundLight();
    fragColor = vec4(mix(ground, sky, smoothstep(-0.01, 0.01, rayDir.y)), 1.0);
}
