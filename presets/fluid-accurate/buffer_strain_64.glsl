// By how much the flow deforms at most, in 64 x 64 parts of the canvas: the largest difference of the velocity of the last
// frame, channel 0, across a cell, along its direction and across it.

float steepest(ivec2 p, ivec2 last) {
    ivec2 l = max(p - ivec2(1, 0), ivec2(0)), r = min(p + ivec2(1, 0), last);
    ivec2 d = max(p - ivec2(0, 1), ivec2(0)), u = min(p + ivec2(0, 1), last);
    vec2 here = texelFetch(iChannel0, p, 0).xy;
    vec2 right = texelFetch(iChannel0, r, 0).xy, up = texelFetch(iChannel0, u, 0).xy;
    float left = texelFetch(iChannel0, l, 0).y, below = texelFetch(iChannel0, d, 0).x;
    vec4 slopes = abs(vec4(right.x - here.x, up.y - here.y, 0.5 * (up.x - below), 0.5 * (right.y - left)));
    return max(max(slopes.x, slopes.y), max(slopes.z, slopes.w));
}

void mainImage(out vec4 most, in vec2 fragCoord) {
    ivec2 size = textureSize(iChannel0, 0), parts = ivec2(iResolution.xy), p = ivec2(fragCoord);
    ivec2 low = size * p / parts, high = size * (p + 1) / parts;
    float slope = 0.0;
    for (int y = low.y; y < high.y; y++) {
        for (int x = low.x; x < high.x; x++) slope = max(slope, steepest(ivec2(x, y), size - 1));
    }
    most = vec4(slope, 0.0, 0.0, 0.0);
}
