// Left Buffer A, right Buffer B: where they meet, a stroke goes on as if there were one buffer. A ring marks where each has
// its memory, and a cross what is remembered there.

vec4 ink(ivec2 p) {
    bool left = 2 * p.x < int(iResolution.x);
    vec4 q = left ? texelFetch(iChannel0, p, 0) : texelFetch(iChannel1, p, 0);
    return isFinite(q) && q.a >= 0.0 ? q : vec4(0.0);
}

float ring(vec2 p, float radius) {
    return clamp(1.5 - abs(length(p) - radius), 0.0, 1.0);
}

float cross_(vec2 p, float size) {
    vec2 q = abs(p);
    return clamp(1.2 - min(q.x, q.y), 0.0, 1.0) * clamp(size - max(q.x, q.y), 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1;
    vec2 uv = fragCoord / iResolution.xy - 0.5;
    bool left = 2 * p.x < int(iResolution.x);
    vec3 tint = left ? vec3(1.00, 0.66, 0.30) : vec3(0.35, 0.75, 1.00);

    // The ink's thickness is a height: light falls on it from the top left.
    vec4 q = ink(p);
    float slope = ink(clamp(p + ivec2(-1, 1), ivec2(0), last)).a - ink(clamp(p + ivec2(1, -1), ivec2(0), last)).a;
    vec3 paper = vec3(0.055, 0.060, 0.080) * (1.1 - 0.9 * dot(uv, uv)) + 0.006 * tint;
    vec3 light = mix(paper, q.rgb / max(q.a, 1e-3) * (0.8 - 0.5 * slope), smoothstep(0.02, 0.6, q.a));

    float size = 0.03 * iResolution.y + 2.0;
    vec4 first = texelFetch(iChannel0, MEMORY, 0), fixed_ = textureLod(iChannel1, MEMORY_UV, 0.0);
    light += 0.7 * vec3(1.00, 0.66, 0.30) * (ring(fragCoord - vec2(0.5), size) + ring(fragCoord - vec2(0.5), 0.5 * size));
    light += 0.7 * vec3(0.35, 0.75, 1.00) * (ring(fragCoord - iResolution.xy + 0.5, size) + ring(fragCoord - iResolution.xy + 0.5, 0.5 * size));
    vec4 mine = left ? first : fixed_;
    if (isMemory(mine, iResolution.xy)) light += (0.25 + 0.5 * mine.z) * cross_(fragCoord - mine.xy - 0.5, size);
    if (p.x == int(iResolution.x) / 2) light += 0.05;
    fragColor = vec4(sqrt(clamp(light, 0.0, 1.0)), 1.0);
}
