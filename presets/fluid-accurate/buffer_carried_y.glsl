// The y component of what is carried, and its second differences.
#define AXIS 1
#include "curves.glsl"
