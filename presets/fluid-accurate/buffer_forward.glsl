// MacCormack, there: every face gets what was upstream. Channels: the drift by components, what is carried by
// components.
#define STEPS 1.0
#include "carry.glsl"
