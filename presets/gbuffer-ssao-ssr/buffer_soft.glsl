// The mean over the texels around, in which Buffer B looks in all its directions; what is of another surface does not
// count. Channel 0 is Buffer B, channel 1 the G-buffer.

void mainImage(out vec4 occluded, in vec2 fragCoord) {
    vec2 canvas = iChannelResolution[1].xy;
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1, full = fullTexel(p, iResolution.xy, canvas);
    vec4 here = texelFetch(iChannel1, full, 0);
    vec3 at = viewFromPixel(vec2(full) + 0.5, here.z, canvas), normal = unpackNormal(here.xy);
    float sum = 0.0, weights = 0.0;
    // Rows and columns count 1 2 3 4 3 2 1: any four in a row have each direction once, so all directions weigh the
    // same wherever the window is, and also on a slope.
    for (int y = -3; y <= 3; y++) {
        for (int x = -3; x <= 3; x++) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last), there = fullTexel(q, iResolution.xy, canvas);
            float weight = float((4 - abs(x)) * (4 - abs(y)));
            weight *= kinship(texelFetch(iChannel1, there, 0), vec2(there) + 0.5, at, normal, here, canvas);
            sum += weight * texelFetch(iChannel0, q, 0).r;
            weights += weight;
        }
    }
    occluded = vec4(clamp(sum / max(weights, 1e-6), 0.0, 1.0), 0.0, 0.0, 1.0);
}
