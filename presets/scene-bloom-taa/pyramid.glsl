// The filters of the bloom's pyramid: thirteen fetches down, a tent up. J. Jimenez, "Next Generation Post Processing in Call
// of Duty: Advanced Warfare", SIGGRAPH 2014 courses. The weights of each sum to one. (The preset bloom-sized has more of it.)

vec4 down13(sampler2D source, vec2 uv, vec2 texel) {
    vec4 inner = vec4(0.0), outer = vec4(0.0);
    for (int i = 0; i < 4; i++) inner += textureLod(source, uv + texel * vec2(2 * (i % 2) - 1, 2 * (i / 2) - 1), 0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            float weight = float((2 - abs(x)) * (2 - abs(y))); // how many of the four outer boxes have this fetch
            outer += weight * textureLod(source, uv + 2.0 * texel * vec2(x, y), 0.0);
        }
    }
    return 0.125 * inner + 0.03125 * outer;
}

vec4 tent(sampler2D source, vec2 uv, vec2 texel) {
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            sum += float((2 - abs(x)) * (2 - abs(y))) * textureLod(source, uv + texel * vec2(x, y), 0.0);
        }
    }
    return sum / 16.0;
}
