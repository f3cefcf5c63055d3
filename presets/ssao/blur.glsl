// The mean of the occlusion over 4 x 4 texels, and of it what is open, to a power. Channel 0 is the occlusion, channel
// 1 has the world's normals, channel 2 depths in w. Texels of another surface do not count.

#iUniform float power = 2.0 in { 0.25, 6.0 } // 1: as measured; more is darker

void mainImage(out vec4 open, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1;
    float depth = texelFetch(iChannel2, p, 0).w;
    vec3 normal = texelFetch(iChannel1, p, 0).xyz;
    // As far apart as texels of one surface are in depth, unless it is seen at a very low angle.
    float near = 0.04 * max(depth, 1e-3);
    float sum = 0.0, weights = 0.0;
    // Four texels wide and about this one: the outer columns and rows count half. Any four in a row have each turn
    // once.
    for (int y = -2; y <= 2; y++) {
        for (int x = -2; x <= 2; x++) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last);
            bool isSame = dot(texelFetch(iChannel1, q, 0).xyz, normal) > 0.8
                       && abs(texelFetch(iChannel2, q, 0).w - depth) < near;
            float weight = isSame ? (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0) : 0.0;
            sum += weight * texelFetch(iChannel0, q, 0).x;
            weights += weight;
        }
    }
    open = vec4(pow(clamp(1.0 - sum / max(weights, 0.25), 0.0, 1.0), power));
}
