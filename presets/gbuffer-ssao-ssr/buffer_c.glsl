// The mean over the square of 4 x 4 texels in which Buffer B looks in all its directions; what lies off the
// surface's plane or faces elsewhere does not count. (Depth alone would weigh a plane seen at a low angle unevenly, and with it
// the directions.) Channel 0 is Buffer B, channel 1 the G-buffer.

void mainImage(out vec4 occluded, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 halfSize = iChannelResolution[0].xy;
    ivec2 centre = ivec2(fragCoord / iResolution.xy * halfSize + 0.5), last = ivec2(halfSize) - 1;
    vec4 here = texelFetch(iChannel1, p, 0);
    vec3 at = viewFromPixel(fragCoord, here.z, iResolution.xy), normal = unpackNormal(here.xy);
    float sum = 0.0, weights = 0.0;
    for (int y = -2; y < 2; y++) {
        for (int x = -2; x < 2; x++) {
            ivec2 q = clamp(centre + ivec2(x, y), ivec2(0), last), full = fullTexel(q, halfSize, iResolution.xy);
            vec4 g = texelFetch(iChannel1, full, 0);
            vec2 turned = g.xy - here.xy; // packed normals: 0.35 is a right angle
            float off = abs(dot(viewFromPixel(vec2(full) + 0.5, g.z, iResolution.xy) - at, normal));
            float near = max(1.0 - off / (0.02 * here.z), 0.0) * max(1.0 - 8.0 * dot(turned, turned), 0.0);
            sum += near * texelFetch(iChannel0, q, 0).r;
            weights += near;
        }
    }
    occluded = vec4(clamp(sum / max(weights, 1e-6), 0.0, 1.0), 0.0, 0.0, 1.0);
}
