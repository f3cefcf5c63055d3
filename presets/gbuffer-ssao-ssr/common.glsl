// Two effects on one G-buffer: light that a corner keeps out, and light that a polished table throws back. Both know
// only what the camera sees, and say so: where the answer lies behind something or beyond the picture's edge, they
// fade.
//
//   A      the G-buffer                               D        reflections: where each one comes from
//   B      ambient occlusion, raw, half the size      light    what each texel sends, without its reflection
//   soft   its noise averaged away, half the size     picture  the two together, as a screen shows them
//   C      at the full size                           Image    edges smoothed
//
// Against 1,024 rays a point in the scene itself, of the same radius and falloff, the occlusion is 0.033 off (root mean
// square, 640 x 360; 0.037 at 320 x 320); 0.04 too little on the die's upright faces, one of which looks at the ball's
// back, which the camera does not see; none on the open table (tests/it/preset_occlusion.rs, `eddy lab ao`).
//
// Its limit: one layer of depths does not tell how thick things are. Behind the mug's handle and below the ball, which
// are thinner than `thickness`, the table is hidden by more than 0.1 too much: 1.8 % of all points at 640 x 640 (1.4 %
// by 8 samples, 2.2 % by 64). With thickness = 0.5 it is 0.5 %, but upright faces get too bright, and the whole is
// 0.045 off in place of 0.038.
//
// Reflections look where the exact ray ends within 0.2 pixels in the median and 1 pixel for 95 of 100 (320 x 320,
// `eddy lab ssr`).

#include "gbuffer.glsl"

#iUniform float thickness = 0.7 in { 0.02, 4.0 } // how deep things are taken to be, behind what the camera sees of them

const int TABLE_MATERIAL = 1;

// Buffer B has half the width and the height of the G-buffer: occlusion changes slowly, and Buffer C knows the edges.
// The texel of the G-buffer that a texel of B stands for.
ivec2 fullTexel(ivec2 p, vec2 halfSize, vec2 fullSize) {
    return min(ivec2((vec2(p) + 0.5) * fullSize / halfSize), ivec2(fullSize) - 1);
}

bool isNothing(vec4 g) {
    return g.z >= 0.999 * FAR;
}

// How far a texel of the G-buffer is of the surface `own` at `at`, which has that normal: 1 to 0. Depth alone would
// weigh a plane seen at a low angle unevenly.
float kinship(vec4 g, vec2 pixel, vec3 at, vec3 normal, vec4 own, vec2 canvas) {
    vec2 turned = g.xy - own.xy; // packed normals: 0.35 is a right angle
    float off = abs(dot(viewFromPixel(pixel, g.z, canvas) - at, normal));
    return max(1.0 - off / (0.02 * own.z), 0.0) * max(1.0 - 8.0 * dot(turned, turned), 0.0);
}

// What is behind everything, and what the table mirrors where nothing else is known.
vec3 backdropOf(vec2 uv) {
    return mix(vec3(0.018, 0.016, 0.018), vec3(0.135, 0.120, 0.110),
               smoothstep(1.1, 0.1, length(uv - vec2(0.42, 0.95))));
}
