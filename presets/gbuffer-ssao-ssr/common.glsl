// Two effects on one G-buffer: light that a corner keeps out, and light that a polished table throws back. Both know only
// what the camera sees, and say so: where the answer lies behind something or beyond the picture's edge, they fade.
//
//   A   the G-buffer                          C   the ambient occlusion, its noise averaged away
//   B   ambient occlusion, raw                D   reflections: where each one comes from

#include "gbuffer.glsl"

const int TABLE_MATERIAL = 1;

bool isNothing(vec4 g) {
    return g.z >= 0.999 * FAR;
}
