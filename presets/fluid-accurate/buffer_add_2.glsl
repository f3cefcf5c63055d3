// Grid 2, going up: what grid 3 found.
#include "add.glsl"
