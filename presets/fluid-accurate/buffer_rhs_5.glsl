// f of grid 5, from grid 4.
#include "rhs.glsl"
