// The base map: colours, and an alpha of spots to cut out.

float star(vec2 p, float radius) {
    float a = atan(p.x, p.y), fifth = 6.28318531 / 5.0;
    a = abs(mod(a + 0.5 * fifth, fifth) - 0.5 * fifth);
    vec2 q = length(p) * vec2(sin(a), cos(a)) - vec2(0.0, radius);
    return dot(q, normalize(vec2(0.72, 0.36)));
}

void mainImage(out vec4 value, in vec2 fragCoord) {
    int page;
    vec2 uv = uvOfTexel(fragCoord, page);
    vec3 colour = vec3(1.0);
    if (page == 1) {
        vec2 q = abs(uv - 0.5);
        vec3 cream = vec3(0.98, 0.93, 0.82), red = vec3(0.90, 0.27, 0.24), gold = vec3(0.99, 0.74, 0.22);
        colour = mix(red, cream, smoothstep(0.40, 0.394, max(q.x, q.y)));
        colour = mix(colour, gold, smoothstep(0.005, -0.005, star(uv - vec2(0.5, 0.48), 0.29)));
    } else if (page == 2) {
        float stripe = abs(fract(14.0 * uv.x + 2.0 * uv.y) - 0.5);
        colour = mix(vec3(0.16, 0.62, 0.60), vec3(0.93, 0.96, 0.86), smoothstep(0.15, 0.20, stripe));
    }
    vec2 spot = fract(uv * vec2(8.0, 6.0) + vec2(0.5 * floor(uv.y * 6.0), 0.0)) - 0.5;
    value = vec4(colour, smoothstep(0.15, 0.45, length(spot)));
}
