// f of grid 2, from grid 1.
#include "rhs.glsl"
