// The x component of the velocity in the middle of the step, and its second differences.
#define AXIS 0
#include "curves.glsl"
