// The x component of what is carried, and its second differences.
#define AXIS 0
#include "curves.glsl"
