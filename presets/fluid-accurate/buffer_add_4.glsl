// Grid 4, going up: what grid 5 found.
#include "add.glsl"
