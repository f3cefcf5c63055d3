// Second of three sub-steps: channel 0 is this frame's Buffer A.
#include "step.glsl"
