// 5 or 9 points.
#ifndef STENCIL
#define STENCIL 5
#endif
// D dt / h^2
#iUniform float rate = 0.16 in { 0.0, 0.4 }
#include "spot.glsl"
