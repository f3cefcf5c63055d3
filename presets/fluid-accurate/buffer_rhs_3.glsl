// f of grid 3, from grid 2.
#include "rhs.glsl"
