#ifndef STENCIL
#define STENCIL 5
#endif
// 1: Strang's splitting, half a step of the reaction before and after the diffusion. Else one step of Euler's.
#ifndef SPLIT
#define SPLIT 0
#endif
#include "gray_scott.glsl"
#include "reacted.glsl"
