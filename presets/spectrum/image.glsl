// Ridges from the nearest to the farthest: the first that reaches a pixel hides those behind it.

#iUniform float height = 0.55 in { 0.1, 1.0 }
#iUniform color3 low = color3(0.16, 0.32, 0.95)
#iUniform color3 high = color3(1.0, 0.45, 0.25)

float level(float at, float row) {
    vec2 size = vec2(textureSize(iChannel0, 0));
    // The rows' own texels on both sides, so that a ridge stays smooth while it moves back.
    float x = (0.5 + at * (size.x - 1.0)) / size.x;
    return texture(iChannel0, vec2(x, (row + 0.5) / size.y)).x;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float aspect = iResolution.x / iResolution.y, pixel = 2.0 / iResolution.y;
    vec3 colour = vec3(0.015, 0.017, 0.03) * (1.0 + p.y);
    // How far the newest row has moved towards the next.
    float moved = fract(iTime * RATE);
    for (int i = 0; i < ROWS - 2; i += 2) {
        float age = float(i) + mod(moved + mod(floor(iTime * RATE), 2.0), 2.0);
        float depth = 1.0 + 0.045 * age;
        float base = 0.55 - 1.4 / depth, half_ = 1.35 * aspect / depth;
        float at = 0.5 + 0.5 * p.x / half_;
        if (at < 0.0 || at > 1.0) continue;
        // Ridges begin and end on the ground.
        float edge = smoothstep(0.0, 0.06, at) * smoothstep(1.0, 0.94, at);
        float value = level(at, min(age, float(ROWS) - 1.0)) * edge;
        float top = base + height * value * value * 1.6 / depth;
        if (p.y > top + 1.5 * pixel) continue;
        vec3 ink = mix(low, high, clamp(1.4 * value - 0.15, 0.0, 1.0)) * exp(-0.045 * age);
        float line = smoothstep(2.0 * pixel, 0.5 * pixel, abs(p.y - top));
        // Below its line a ridge glows a little and hides what is behind.
        vec3 fill = 0.16 * ink * exp(-6.0 * max(top - p.y, 0.0) * depth) + vec3(0.012, 0.013, 0.022);
        float inside = smoothstep(1.5 * pixel, -0.5 * pixel, p.y - top);
        vec3 ridge = mix(fill, 1.5 * ink, line);
        colour = mix(colour, ridge, max(inside, line));
        if (inside > 0.99) break;
    }
    // The wave, 11.6 ms of it.
    float wave = 0.78 + 0.16 * texture(iChannel0, vec2(0.5 + 0.5 * p.x / (0.9 * aspect), 0.0)).y;
    float shown = step(abs(p.x), 0.9 * aspect) * smoothstep(2.2 * pixel, 0.6 * pixel, abs(p.y - wave));
    colour += shown * mix(low, vec3(1.0), 0.5);
    fragColor = vec4(pow(colour, vec3(1.0 / 2.2)), 1.0);
}
