// Grid 1, going down.
#include "pre.glsl"
