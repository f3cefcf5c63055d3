// The sky in all directions. It depends on the sliders alone, so it is drawn once and kept while they stay.

// Clouds in a layer, as thick as noise in octaves says.
vec3 withClouds(Sky sky, vec3 clear, vec3 direction) {
    if (direction.y < 0.02 || clouds == 0.0) return clear;
    vec3 at = vec3(direction.xz / (direction.y + 0.12), 0.0) * 1.7;
    float thick = 0.0, share = 0.5;
    for (int octave = 0; octave < 5; octave++) {
        thick += share * noise(at + 17.0 * float(octave));
        at *= 2.03;
        share *= 0.5;
    }
    float cover = smoothstep(1.0 - clouds, 1.25 - 0.6 * clouds, thick + 0.25);
    return mix(clear, cloudLight(sky, direction), cover * smoothstep(0.02, 0.2, direction.y));
}

void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) {
    vec3 light = GROUND * texelFetch(iChannel0, ivec2(6, 0), 0).rgb;
    if (rayDir.y > -0.01) {
        Sky sky;
        for (int i = 0; i < 3; i++) {
            sky.abcd[i] = texelFetch(iChannel0, ivec2(i, 0), 0);
            sky.rest[i] = texelFetch(iChannel0, ivec2(i + 3, 0), 0).xy;
        }
        vec3 above = withClouds(sky, clearSky(sky, rayDir), rayDir);
        // The sun is 0.53 degrees wide, and here not brighter than half floats can average.
        float toSun = dot(rayDir, sunDirection());
        above += 200.0 * vec3(1.0, 0.85, 0.6) * smoothstep(cos(radians(0.45)), cos(radians(0.2)), toSun);
        light = mix(light, above, smoothstep(-0.01, 0.01, rayDir.y));
    }
    fragColor = vec4(light, 1.0);
}
