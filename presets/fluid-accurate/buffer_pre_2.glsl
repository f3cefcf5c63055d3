// Grid 2, going down.
#include "pre.glsl"
