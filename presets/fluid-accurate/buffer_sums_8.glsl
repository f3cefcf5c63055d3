// The same in 8 x 8 parts.
#define OF(q) q.xy
#define WEIGHT 1.0
#include "sums.glsl"
