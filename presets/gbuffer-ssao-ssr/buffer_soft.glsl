// The mean over the texels around, in which Buffer B looks in all its directions; what is of another surface does not count.
// Channel 0 is Buffer B, channel 1 the G-buffer.

void mainImage(out vec4 occluded, in vec2 fragCoord) {
    vec2 canvas = iChannelResolution[1].xy;
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1, full = fullTexel(p, iResolution.xy, canvas);
    vec4 here = texelFetch(iChannel1, full, 0);
    vec3 at = viewFromPixel(vec2(full) + 0.5, here.z, canvas);
    float sum = 0.0, weights = 0.0;
    // Four texels wide and about this one: the outer columns and rows count half. Any four in a row have each direction once.
    for (int y = -2; y <= 2; y++) {
        for (int x = -2; x <= 2; x++) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last), there = fullTexel(q, iResolution.xy, canvas);
            float weight = (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0);
            weight *= kinship(texelFetch(iChannel1, there, 0), vec2(there) + 0.5, at, here.xy, canvas);
            sum += weight * texelFetch(iChannel0, q, 0).r;
            weights += weight;
        }
    }
    occluded = vec4(clamp(sum / max(weights, 1e-6), 0.0, 1.0), 0.0, 0.0, 1.0);
}
