// The x component of what the first step of MacCormack brought, and its second differences.
#define AXIS 0
#include "curves.glsl"
