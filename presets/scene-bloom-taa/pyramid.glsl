// The filters of the bloom's pyramid: thirteen fetches down, a tent up. J. Jimenez, "Next Generation Post Processing in Call
// of Duty: Advanced Warfare", SIGGRAPH 2014 courses. The weights of each sum to one. (The preset bloom-sized has more of it, and
// says why texel i of a level is always over texels 2 i and 2 i + 1 of the one before.)

// A place in a picture, in texels, where the picture is so many texels wide and high and mirrored beyond its edges; over the
// size of its texture.
vec2 folded(vec2 at, vec2 extent, sampler2D source) {
    return (extent - abs(extent - abs(at))) / vec2(textureSize(source, 0));
}

vec4 down13(sampler2D source, vec2 at, vec2 extent) {
    vec4 inner = vec4(0.0), outer = vec4(0.0);
    for (int i = 0; i < 4; i++) {
        inner += textureLod(source, folded(at + vec2(2 * (i % 2) - 1, 2 * (i / 2) - 1), extent, source), 0.0);
    }
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            float weight = float((2 - abs(x)) * (2 - abs(y))); // how many of the four outer boxes have this fetch
            outer += weight * textureLod(source, folded(at + 2.0 * vec2(x, y), extent, source), 0.0);
        }
    }
    return 0.125 * inner + 0.03125 * outer;
}

vec4 tent(sampler2D source, vec2 at, vec2 extent) {
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            float weight = float((2 - abs(x)) * (2 - abs(y)));
            sum += weight * textureLod(source, folded(at + vec2(x, y), extent, source), 0.0);
        }
    }
    return sum / 16.0;
}
