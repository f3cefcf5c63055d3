// Grid 0, going up: what grid 1 found.
#include "add.glsl"
