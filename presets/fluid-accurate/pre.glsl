// Going down: two Jacobi sweeps from q = 0, in one pass, as the first sweep is only f scaled. Channel 0 is f, channel 1
// any texture of the finest grid. Gives (q, f).
#include "multigrid.glsl"

ivec2 size;
vec2 w;

// One sweep from zero.
float swept(ivec2 p) {
    if (!hasCell(p, size)) return 0.0;
    p = cellAt(p, size);
    float d = diagonal(p, size, w);
    return d > 0.0 ? -DAMPING * texelFetch(iChannel0, p, 0).x / d : 0.0;
}

void mainImage(out vec4 result, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    size = textureSize(iChannel0, 0);
    w = stiffnessOf(size, textureSize(iChannel1, 0));
    float f = texelFetch(iChannel0, p, 0).x, d = diagonal(p, size, w), q = swept(p);
    float around = w.x * (swept(p - ivec2(1, 0)) + swept(p + ivec2(1, 0)))
                 + w.y * (swept(p - ivec2(0, 1)) + swept(p + ivec2(0, 1)));
    if (d > 0.0) q += DAMPING * (around - d * q - f) / d;
    result = vec4(orZero(q), f, 0.0, 0.0);
}
