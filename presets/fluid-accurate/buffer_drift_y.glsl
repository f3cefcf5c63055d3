// The y component of the velocity in the middle of the step, and its second differences.
#define AXIS 1
#include "curves.glsl"
