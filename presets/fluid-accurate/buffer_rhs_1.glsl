// f of grid 1, from grid 0.
#include "rhs.glsl"
