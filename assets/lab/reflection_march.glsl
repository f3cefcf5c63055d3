// Reflections by equal steps in space, in place of the preset's Buffer D: the plainest way. The first step that is behind what the
// G-buffer has there, by no more than the thickness and a step, is where the ray hits; HALVED: from there halved to the place.

#iUniform int strides = 24 in { 4, 128 }

const float REACH = 7.0;

bool isBehind(vec3 p, float slack, out vec2 at) {
    at = pixelFromView(p, iResolution.xy);
    ivec2 texel = clamp(ivec2(at), ivec2(0), ivec2(iResolution.xy) - 1);
    vec4 there = texelFetch(iChannel0, texel, 0);
    return -p.z > there.z && -p.z < there.z + slack && int(there.w) != TABLE_MATERIAL;
}

void mainImage(out vec4 hit, in vec2 fragCoord) {
    vec4 g = texelFetch(iChannel0, ivec2(fragCoord), 0);
    hit = vec4(0.0);
    if (isNothing(g) || int(g.w) != TABLE_MATERIAL) return;
    vec3 from = viewFromPixel(fragCoord, g.z, iResolution.xy), ray = reflect(normalize(from), unpackNormal(g.xy));
    float step_ = REACH / float(strides), slack = thickness + step_;
    for (int i = 1; i <= strides; i++) {
        vec3 p = from + float(i) * step_ * ray;
        vec2 at = pixelFromView(p, iResolution.xy);
        if (p.z > -1e-3 || any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, iResolution.xy))) return;
        if (!isBehind(p, slack, at)) continue;
#if HALVED == 1
        float low = float(i - 1) * step_, high = float(i) * step_;
        for (int j = 0; j < 8; j++) {
            float middle = 0.5 * (low + high);
            if (isBehind(from + middle * ray, slack, at)) high = middle;
            else low = middle;
        }
        at = pixelFromView(from + high * ray, iResolution.xy);
#endif
        hit = vec4(at / iResolution.xy, 1.0, 1.0);
        return;
    }
}
