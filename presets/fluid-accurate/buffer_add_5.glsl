// Grid 5, going up: what grid 6 found.
#include "add.glsl"
