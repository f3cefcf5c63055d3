// Unpacks the pyramid, mixes it in, and fits the light into what a screen can show. Channel 0 is Buffer A, 1 is Buffer
// D.

#iUniform bool showPyramid = false

// A level spread out over the canvas again by cubic B-splines: 16 texels in four bilinear fetches (C. Sigg, M.
// Hadwiger, "Fast Third-Order Texture Filtering", GPU Gems 2, 2005).
vec3 level(Tile t, vec2 uv) {
    vec2 at = uv * vec2(t.size) - 0.5, base = floor(at), f = at - base, e = 1.0 - f;
    vec2 low = (e * e * e + 4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0, high = 1.0 - low;
    vec2 from = vec2(t.from) + base + 0.5;
    vec2 a = (from - e * e * e / 6.0 / low) / iResolution.xy;
    vec2 b = (from + 1.0 + f * f * f / 6.0 / high) / iResolution.xy;
    return low.y * (low.x * textureLod(iChannel1, a, 0.0).rgb + high.x * textureLod(iChannel1, vec2(b.x, a.y), 0.0).rgb)
         + high.y * (low.x * textureLod(iChannel1, vec2(a.x, b.y), 0.0).rgb
                     + high.x * textureLod(iChannel1, b, 0.0).rgb);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 sharp = texelFetch(iChannel0, ivec2(fragCoord), 0).rgb;
    vec3 sum = vec3(0.0);
    float weights = 0.0, weight = 1.0;
    ivec2 canvas = ivec2(iResolution.xy);
    // A canvas too small for a pyramid keeps its picture as it is.
    for (Tile t = firstTile(canvas); t.level > 0; t = nextTile(t, canvas)) {
        sum += weight * level(t, uv);
        weights += weight;
        weight *= spread;
    }
    vec3 light = weights > 0.0 ? mix(sharp, sum / weights, strength) : sharp;
    if (showPyramid) light = texelFetch(iChannel1, ivec2(fragCoord), 0).rgb;
    fragColor = vec4(sqrt(reinhard(light * exp2(exposure))), 1.0);
}
