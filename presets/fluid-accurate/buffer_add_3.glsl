// Grid 3, going up: what grid 4 found.
#include "add.glsl"
