// The dye of the last frame, in 64 x 64 parts.
#define OF(q) vec2(q.r + q.g + q.b, q.a)
#define WEIGHT (1.0 / float(size.x * size.y))
#include "sums.glsl"
