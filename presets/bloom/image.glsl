// Unpacks the pyramid, mixes it in, and fits the light into what a screen can show. Channel 0 is Buffer A, 1 is Buffer D.

#iUniform bool showPyramid = false

// A level spread out over the canvas again. The four bilinear fetches a third of a texel off centre round the corners that
// one fetch would leave.
vec3 level(Tile t, vec2 uv) {
    vec2 inner = vec2(t.size - 2 * PAD), at = vec2(t.from + PAD) + uv * inner;
    const vec2 OFF = vec2(0.33, -0.33);
    return 0.25 * (textureLod(iChannel1, (at + OFF.xx) / iResolution.xy, 0.0).rgb
                 + textureLod(iChannel1, (at + OFF.xy) / iResolution.xy, 0.0).rgb
                 + textureLod(iChannel1, (at + OFF.yx) / iResolution.xy, 0.0).rgb
                 + textureLod(iChannel1, (at + OFF.yy) / iResolution.xy, 0.0).rgb);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 sharp = texelFetch(iChannel0, ivec2(fragCoord), 0).rgb;
    vec3 sum = vec3(0.0);
    float weights = 0.0, weight = 1.0;
    for (int k = 1; k <= LEVELS; k++) {
        Tile t = tile(k, ivec2(iResolution.xy));
        if (t.level == 0) break; // a canvas too small for a pyramid keeps its picture as it is
        sum += weight * level(t, uv);
        weights += weight;
        weight *= spread;
    }
    vec3 light = weights > 0.0 ? mix(sharp, sum / weights, strength) : sharp;
    if (showPyramid) light = texelFetch(iChannel1, ivec2(fragCoord), 0).rgb;
    fragColor = vec4(sqrt(reinhard(light * exp2(exposure))), 1.0);
}
