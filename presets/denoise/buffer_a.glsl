// The picture with noise on it. Without a video it is a scene of our own, with what is hard for a filter: edges, fine
// lines, smooth slopes and texture.

vec3 scene(vec2 p) {
    float t = 0.3 * iTime;
    // A slope that a filter must not break into steps.
    vec3 colour = mix(vec3(0.22, 0.30, 0.42), vec3(0.80, 0.72, 0.58), smoothstep(-1.0, 1.0, p.y + 0.2 * sin(p.x + t)));
    // Lines of falling width.
    float rows = sin(90.0 * p.x * (1.2 + p.x));
    if (p.y < -0.55) colour *= 0.55 + 0.45 * step(0.0, rows);
    for (int i = 0; i < 5; i++) {
        float turn = t + 1.2566 * float(i);
        vec2 to = p - vec2(1.0 * cos(turn), 0.42 * sin(1.3 * turn) + 0.1);
        float d = length(to);
        vec3 ink = 0.5 + 0.42 * cos(vec3(0.0, 2.1, 4.2) + 1.7 * float(i));
        // A ball with rings on it, as fine as the texels allow.
        float shade = 0.55 + 0.45 * sqrt(max(1.0 - d * d / 0.0625, 0.0));
        ink *= shade * (0.9 + 0.1 * cos(90.0 * d));
        colour = mix(colour, ink, smoothstep(0.25, 0.25 - 3.0 / iResolution.y, d));
    }
    return colour;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 size = iChannelResolution[0].xy;
    vec3 colour;
    if (size.x > 1.0 && texture(iChannel0, vec2(0.5)).a > 0.0 && iChannelTime[0] >= 0.0 && size.x != 320.0) {
        // The video fills the canvas and keeps its shape.
        vec2 scale = iResolution.xy / size;
        vec2 uv = 0.5 + (fragCoord - 0.5 * iResolution.xy) / (size * max(scale.x, scale.y));
        colour = texture(iChannel0, uv).rgb;
    } else {
        colour = scene((2.0 * fragCoord - iResolution.xy) / iResolution.y);
    }
    colour += noise * normal3(uvec3(uvec2(fragCoord), uint(iFrame)));
    fragColor = vec4(colour, 1.0);
}
