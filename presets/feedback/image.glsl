// Colours the trails by age. Channel 0 is Buffer A.

// A glow that cools: nearly white when fresh, then `hot`, then `cold`, gone after twelve half-lives.
vec3 ribbon(float trail, vec3 hot, vec3 cold) {
    float t = clamp(age(trail) / 12.0, 0.0, 1.0);
    vec3 colour = mix(hot, cold, smoothstep(0.10, 0.65, t));
    colour = mix(vec3(1.0, 0.98, 0.94), colour, smoothstep(0.0, 0.14, t));
    float fade = 1.0 - t;
    return 1.2 * colour * fade * fade * fade;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    // Texel (0, 0) holds the mouse: show its neighbour there. (On a canvas of one texel there is none, and it stays
    // dark.)
    ivec2 p = ivec2(fragCoord);
    vec4 trail = texelFetch(iChannel0, p == MOUSE ? ivec2(1, 0) : p, 0);

    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 light = mix(vec3(0.009, 0.011, 0.024), vec3(0.004, 0.005, 0.012), min(length(uv), 1.0));
    light += ribbon(trail.x, vec3(1.00, 0.55, 0.10), vec3(0.60, 0.02, 0.16));
    light += ribbon(trail.y, vec3(0.15, 0.85, 0.90), vec3(0.10, 0.08, 0.65));
    light += ribbon(trail.w, vec3(0.45, 0.95, 0.35), vec3(0.02, 0.30, 0.30));
    light += ribbon(trail.z, vec3(0.95, 0.30, 0.75), vec3(0.25, 0.05, 0.55));
    fragColor = vec4(sqrt(light), 1.0);
}
