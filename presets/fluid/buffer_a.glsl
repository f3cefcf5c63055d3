// First of three sub-steps: channel 0 is Buffer C as the last frame left it.
#include "step.glsl"
