// Glazed ceramic: V is the height of the relief. Shading: J. Blinn, "Models of Light Reflection", SIGGRAPH 1977.
// Channel 0 is Buffer A.

float height(ivec2 p) {
    return smoothstep(0.04, 0.42, texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1), 0).y);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 state = texelFetch(iChannel0, p, 0).xy;
    float h = height(p);
    vec2 slope = vec2(height(p - ivec2(1, 0)) - height(p + ivec2(1, 0)),
                      height(p - ivec2(0, 1)) - height(p + ivec2(0, 1)));
    vec3 n = normalize(vec3(2.6 * slope, 1.0));
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 sun = normalize(vec3(-0.45, 0.65, 0.75)), eye = normalize(vec3(-uv, 2.2));

    // The valley's colour deepens where U is used up; the ridge is bare clay with an iron rim where it is young.
    vec3 valley = glaze * mix(1.15, 0.35, smoothstep(0.0, 0.75, state.x));
    vec3 rim = mix(glaze, vec3(0.78, 0.34, 0.12), 0.85);
    vec3 colour = mix(valley, rim, smoothstep(0.06, 0.45, h));
    colour = mix(colour, clay, smoothstep(0.45, 0.9, h));
    float cavity = h - 0.25 * (height(p + ivec2(4, 0)) + height(p - ivec2(4, 0)) + height(p + ivec2(0, 4))
                               + height(p - ivec2(0, 4)));
    colour *= 1.0 + 0.45 * cavity;
    colour *= 0.42 + 0.72 * max(dot(n, sun), 0.0);
    vec3 sky = mix(vec3(0.30, 0.34, 0.40), vec3(0.95, 0.97, 1.0), smoothstep(-0.3, 0.9, reflect(-eye, n).y));
    float fresnel = 0.04 + 0.5 * pow(1.0 - clamp(dot(n, eye), 0.0, 1.0), 3.0);
    colour = mix(colour, sky, fresnel * (1.0 - 0.6 * h));
    colour += 0.55 * pow(max(dot(n, normalize(sun + eye)), 0.0), 60.0);
    colour *= 1.0 - 0.28 * min(dot(uv, uv), 1.0);

    if (dt > longestStep() && fragCoord.y < 0.03 * iResolution.y
        && mod(fragCoord.x + fragCoord.y, 0.06 * iResolution.y) < 0.03 * iResolution.y) {
        colour = vec3(0.85, 0.1, 0.1);
    }
    fragColor = vec4(pow(max(colour, 0.0), vec3(1.0 / 1.6)), 1.0);
}
