// The mean of the canvas, in parts: a texel takes the sum over its part of channel 0. x: dye, y: dye that was poured.
// The text that includes this says what a texel of channel 0 holds of them, OF(q), and how much the sum weighs, WEIGHT.

void mainImage(out vec4 sums, in vec2 fragCoord) {
    ivec2 size = textureSize(iChannel0, 0), parts = ivec2(iResolution.xy), p = ivec2(fragCoord);
    ivec2 low = size * p / parts, high = size * (p + 1) / parts;
    vec2 sum = vec2(0.0);
    for (int y = low.y; y < high.y; y++) {
        vec2 row = vec2(0.0);
        for (int x = low.x; x < high.x; x++) {
            vec4 q = texelFetch(iChannel0, ivec2(x, y), 0);
            if (isFinite(q)) row += OF(q);
        }
        sum += row;
    }
    sums = vec4(WEIGHT * sum, 0.0, 0.0);
}
