// Grid 1, going up: what grid 2 found.
#include "add.glsl"
