// The occlusion at the full size: between the four nearest texels, as far as they are of the same surface. Channel 0 is
// the occlusion at half the size, channel 1 the G-buffer.

void mainImage(out vec4 occluded, in vec2 fragCoord) {
    vec2 halfSize = iChannelResolution[0].xy, from = fragCoord / iResolution.xy * halfSize - 0.5, f = fract(from);
    ivec2 base = ivec2(floor(from)), last = ivec2(halfSize) - 1;
    vec4 here = texelFetch(iChannel1, ivec2(fragCoord), 0);
    vec3 at = viewFromPixel(fragCoord, here.z, iResolution.xy), normal = unpackNormal(here.xy);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; i++) {
        ivec2 off = ivec2(i & 1, i >> 1), q = clamp(base + off, ivec2(0), last);
        ivec2 full = fullTexel(q, halfSize, iResolution.xy);
        vec2 near = mix(1.0 - f, f, vec2(off));
        // Where all four are of other surfaces, on what is thinner than two pixels, their mean is as good a guess as
        // any.
        float kin = kinship(texelFetch(iChannel1, full, 0), vec2(full) + 0.5, at, normal, here, iResolution.xy);
        float weight = near.x * near.y * max(kin, 1e-4);
        sum += weight * texelFetch(iChannel0, q, 0).r;
        weights += weight;
    }
    occluded = vec4(isNothing(here) ? 0.0 : sum / max(weights, 1e-9), 0.0, 0.0, 1.0);
}
