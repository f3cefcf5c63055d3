// The filters of the bloom's pyramid: up by a 3 x 3 tent (J. Jimenez, "Next Generation Post Processing in Call of Duty:
// Advanced Warfare", SIGGRAPH 2014 courses), down by its transpose. The weights of each sum to one. The preset
// bloom-sized has more of it, and says why light is kept times alpha on the way down, and what that does at the far
// edges.

// Texels of level k that the picture covers; 0 is the picture.
ivec2 levelSize(int k, vec2 canvas, vec2 buffer_) {
    return min((ivec2(canvas) + (1 << k) - 1) >> k, ivec2(buffer_));
}

vec2 folded(vec2 at, vec2 extent) {
    return extent - abs(extent - abs(at));
}

// What is at a place of a level, times how much there is of it.
vec4 fetched(sampler2D source, vec2 at, vec2 size, vec2 extent, bool isPicture) {
    at = folded(at, extent);
    vec2 part = 1.0 - clamp(extent - size, 0.0, 1.0) * clamp(at - size + 0.5, 0.0, 1.0);
    vec4 light = textureLod(source, min(at, size - 0.5) / vec2(textureSize(source, 0)), 0.0);
    return part.x * part.y * (isPicture ? vec4(light.rgb, 1.0) : light);
}

// A texel of level k out of the level before: light times alpha, and alpha.
vec4 down(sampler2D source, vec2 fragCoord, int k, vec2 canvas, vec2 resolution) {
    const float PLACE[4] = float[4](-2.75, -11.0 / 12.0, 11.0 / 12.0, 2.75),
        WEIGHT[4] = float[4](0.125, 0.375, 0.375, 0.125);
    vec2 own = vec2(levelSize(k, canvas, resolution));
    if (any(greaterThan(fragCoord, own))) return vec4(0.0);
    vec2 size = vec2(levelSize(k - 1, canvas, vec2(textureSize(source, 0))));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; i++) {
        vec2 at = 2.0 * fragCoord + vec2(PLACE[i % 4], PLACE[i / 4]);
        sum += WEIGHT[i % 4] * WEIGHT[i / 4] * fetched(source, at, size, 2.0 * own, k == 1);
    }
    return sum;
}

// A texel of level k - 1 out of level k, whose light is no longer times alpha.
vec4 tent(sampler2D source, vec2 fragCoord, int k, vec2 canvas) {
    vec2 texels = vec2(textureSize(source, 0)), extent = vec2(levelSize(k, canvas, texels));
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            vec2 at = min(folded(0.5 * fragCoord + vec2(x, y), extent), extent - 0.5);
            sum += float((2 - abs(x)) * (2 - abs(y))) * textureLod(source, at / texels, 0.0);
        }
    }
    return sum / 16.0;
}

vec4 plain(vec4 light) {
    return vec4(light.rgb / max(light.a, 1e-4), 1.0);
}
