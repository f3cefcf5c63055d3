// Two effects on one G-buffer: light that a corner keeps out, and light that a polished table throws back. Both know only
// what the camera sees, and say so: where the answer lies behind something or beyond the picture's edge, they fade.
//
//   A   the G-buffer                          C   the ambient occlusion, its noise averaged away
//   B   ambient occlusion, raw, half the size D   reflections: where each one comes from

#include "gbuffer.glsl"

const int TABLE_MATERIAL = 1;

// Buffer B has half the width and the height of the G-buffer: occlusion changes slowly, and Buffer C knows the edges. The
// texel of the G-buffer that a texel of B stands for.
ivec2 fullTexel(ivec2 p, vec2 halfSize, vec2 fullSize) {
    return min(ivec2((vec2(p) + 0.5) * fullSize / halfSize), ivec2(fullSize) - 1);
}

bool isNothing(vec4 g) {
    return g.z >= 0.999 * FAR;
}
