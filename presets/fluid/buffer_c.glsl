// Third of three sub-steps: channel 0 is this frame's Buffer B.
#include "step.glsl"
