// f of grid 4, from grid 3.
#include "rhs.glsl"
