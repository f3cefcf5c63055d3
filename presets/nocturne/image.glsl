// What is played now and next: sixteenths come from the right, and glow as they pass the line.

vec3 inkOf(int note) {
    return 0.55 + 0.45 * cos(6.2831853 * (float(note % 12) / 12.0 + vec3(0.0, 0.33, 0.67)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float aspect = iResolution.x / iResolution.y, pixel = 2.0 / iResolution.y;
    float now = iTime / SIXTEENTH, line = -0.45 * aspect;
    int bar = int(floor(iTime / BAR));
    float inBar = iTime / BAR - float(bar);
    vec3 chord = inkOf(rootOf(bar)) * smoothstep(0.0, 0.08, inBar) + inkOf(rootOf(bar - 1)) * smoothstep(0.08, 0.0, inBar);
    vec3 colour = mix(vec3(0.012, 0.012, 0.03), 0.05 * chord, 0.5 + 0.5 * p.y);
    // The chord as four horizons.
    for (int i = 0; i < 4; i++) {
        float y = (float(rootOf(bar) + chordOf(bar)[i]) - 64.0) / 26.0;
        colour += 0.10 * chord * exp(-abs(p.y - y) * 26.0) * (0.4 + 0.6 * exp(-2.0 * inBar));
    }
    const float WIDE = 0.13;
    int first = int(floor(now + (p.x - line) / WIDE));
    for (int k = -3; k <= 3; k++) {
        int note = arpeggio(first + k);
        if (note == 0) continue;
        vec2 at = vec2(line + (float(first + k) + 0.5 - now) * WIDE, (float(note) - 76.0) / 22.0);
        float since = (now - float(first + k)) * SIXTEENTH, alive = since > 0.0 ? exp(-3.2 * since) : 0.0;
        float far = length(p - at);
        float radius = 0.022 + 0.02 * alive;
        vec3 ink = inkOf(note);
        colour += ink * (0.25 + 1.6 * alive) * smoothstep(radius + pixel, radius - pixel, far);
        colour += ink * alive * 0.008 / (far * far + 0.008) * smoothstep(0.38, 0.05, far);
    }
    colour += 0.08 * smoothstep(1.5 * pixel, 0.0, abs(p.x - line));
    // The beat, along the foot.
    float beat = fract(iTime / BEAT);
    colour += 0.12 * chord * exp(-6.0 * beat) * smoothstep(-0.7, -1.0, p.y);
    fragColor = vec4(pow(colour / (1.0 + 0.5 * colour), vec3(1.0 / 2.2)), 1.0);
}
