// The y component of what the first step of MacCormack brought, and its second differences.
#define AXIS 1
#include "curves.glsl"
