// Grid 4, going down.
#include "pre.glsl"
