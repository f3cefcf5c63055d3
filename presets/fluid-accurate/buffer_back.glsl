// MacCormack, and back: what came is carried back to where it was. Channels: the drift by components, Buffer forward by
// components.
#define STEPS -1.0
#define TRUST
#include "carry.glsl"
