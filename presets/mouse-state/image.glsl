// Left Buffer A, right Buffer B: where they meet, a stroke goes on as if there were one buffer. A ring marks where each
// has its memory, and a cross what is remembered there.

vec4 ink(ivec2 p) {
    p = clamp(p, ivec2(0), ivec2(iResolution.xy) - 1);
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
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    bool left = 2 * p.x < int(iResolution.x);
    vec3 amber = vec3(1.00, 0.62, 0.26), azure = vec3(0.30, 0.70, 1.00);

    // Threads of glass on dark velvet: the ink's thickness is a height, light falls on it from the top left.
    vec4 q = ink(p);
    float scale = iResolution.y / 360.0;
    vec2 slope = vec2(ink(p - ivec2(1, 0)).a - ink(p + ivec2(1, 0)).a, ink(p - ivec2(0, 1)).a - ink(p + ivec2(0, 1)).a);
    vec3 n = normalize(vec3(3.5 * scale * slope, 1.0)), sun = normalize(vec3(-0.5, 0.7, 0.7));
    vec3 glow = vec3(0.0); // what the threads send on to the velvet: 24 looks around, on a spiral of the golden angle
    for (int i = 0; i < 24; i++) {
        float r = sqrt((float(i) + 0.5) / 24.0), a = 2.39996323 * float(i);
        glow += ink(p + ivec2(22.0 * scale * r * vec2(cos(a), sin(a)))).rgb * (1.0 - 0.8 * r) / 24.0;
    }
    float cloth = 0.5 + 0.5 * sin(2.1 * float(p.x + p.y)) * sin(2.1 * float(p.x - p.y));
    vec3 velvet = (left ? vec3(0.022, 0.012, 0.016) : vec3(0.010, 0.014, 0.026)) * (0.85 + 0.3 * cloth);
    vec3 light = velvet * (1.25 - 1.1 * dot(uv, uv)) + 0.55 * glow;
    vec3 own = q.rgb / max(q.a, 1e-3);
    float cover = smoothstep(0.04, 0.5, q.a), shine = pow(max(dot(n, normalize(sun + vec3(0.0, 0.0, 1.0))), 0.0), 40.0);
    light = mix(light, own * own * (0.25 + 0.85 * max(dot(n, sun), 0.0)) + 0.55 * shine * q.a, cover);

    float size = 0.03 * iResolution.y + 2.0;
    vec2 first = fragCoord - vec2(0.5), fixed_ = fragCoord - iResolution.xy + 0.5;
    light += 0.6 * amber * (ring(first, size) + ring(first, 0.5 * size));
    light += 0.6 * azure * (ring(fixed_, size) + ring(fixed_, 0.5 * size));
    vec4 mine = left ? texelFetch(iChannel0, MEMORY, 0) : textureLod(iChannel1, MEMORY_UV, 0.0);
    if (isMemory(mine, iResolution.xy)) light += (0.2 + 0.4 * mine.z) * cross_(fragCoord - mine.xy - 0.5, 0.6 * size);
    if (p.x == int(iResolution.x) / 2) light += 0.02;
    fragColor = vec4(pow(1.0 - exp(-1.6 * max(light, 0.0)), vec3(1.0 / 2.2)), 1.0);
}
