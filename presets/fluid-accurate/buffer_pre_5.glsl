// Grid 5, going down.
#include "pre.glsl"
