// Grid 3, going down.
#include "pre.glsl"
