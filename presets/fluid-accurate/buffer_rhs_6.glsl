// f of grid 6, from grid 5.
#include "rhs.glsl"
