// Grid 0, going down.
#include "pre.glsl"
