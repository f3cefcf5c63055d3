// Night: what was exposed, its glow, and its reflection in a wet floor. Channel 0 is the light.

vec3 lightAt(vec2 at) {
    vec2 uv = (at * iResolution.y + 0.5 * iResolution.xy) / iResolution.xy;
    return textureLod(iChannel0, uv, 0.0).rgb;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 at = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 shown = lightAt(at);
    // A cheap glow: eight looks on a spiral.
    for (int i = 1; i <= 8; i++) {
        float a = 2.399963 * float(i), r = 0.0055 * float(i);
        shown += 0.10 * lightAt(at + r * vec2(cos(a), sin(a))) * exp(-0.22 * float(i));
    }
    vec3 night = mix(vec3(0.030, 0.034, 0.060), vec3(0.006, 0.007, 0.016), smoothstep(-0.4, 0.6, at.y));
    if (at.y < FLOOR) {
        float depth = FLOOR - at.y;
        vec2 mirrored = vec2(at.x, FLOOR + depth);
        vec3 wet = vec3(0.0);
        for (int i = -2; i <= 2; i++) {
            vec2 smear = vec2(0.004 * sin(90.0 * at.y + 3.0 * float(i)), 0.030 * float(i) * (0.2 + 3.0 * depth));
            wet += 0.2 * lightAt(mirrored + smear);
        }
        shown += 0.65 * wet * exp(-5.0 * depth);
        night = mix(vec3(0.016, 0.018, 0.026), vec3(0.008, 0.009, 0.014), depth / 0.15);
    }
    shown = night + 1.0 - exp(-shown);
    vec2 uv = at * vec2(iResolution.y / iResolution.x, 1.0);
    fragColor = vec4(pow(shown, vec3(1.0 / 1.7)) * (1.0 - 0.7 * dot(uv, uv)), 1.0);
}
