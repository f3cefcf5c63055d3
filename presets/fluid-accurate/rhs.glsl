// Going down: what two sweeps left undone, f - lap q, as the next coarser grid's f: the mean over each of its cells.
// Channel 0 is the finer grid's (q, f), channel 1 any texture of the finest grid.
#include "multigrid.glsl"

// A neighbour beyond the wall is the cell itself: no gradient.
float q(ivec2 p, ivec2 size) {
    return texelFetch(iChannel0, cellAt(p, size), 0).x;
}

void mainImage(out vec4 f, in vec2 fragCoord) {
    ivec2 fine = textureSize(iChannel0, 0);
    vec2 w = stiffnessOf(fine, textureSize(iChannel1, 0));
    // The part of the finer grid under this cell, in its cells.
    vec2 ratio = vec2(fine) / iResolution.xy;
    vec2 low = floor(fragCoord) * ratio, high = min(low + ratio, vec2(fine));
    float sum = 0.0, area = 0.0;
    for (int y = int(low.y + 1e-3); float(y) < high.y - 1e-3; y++) {
        for (int x = int(low.x + 1e-3); float(x) < high.x - 1e-3; x++) {
            ivec2 p = ivec2(x, y);
            vec2 overlap = min(high, vec2(p + 1)) - max(low, vec2(p));
            vec2 here = texelFetch(iChannel0, p, 0).xy;
            float lap = w.x * ((q(p - ivec2(1, 0), fine) - here.x) + (q(p + ivec2(1, 0), fine) - here.x))
                      + w.y * ((q(p - ivec2(0, 1), fine) - here.x) + (q(p + ivec2(0, 1), fine) - here.x));
            sum += overlap.x * overlap.y * (here.y - lap);
            area += overlap.x * overlap.y;
        }
    }
    f = vec4(orZero(sum / max(area, 1e-6)), 0.0, 0.0, 0.0);
}
