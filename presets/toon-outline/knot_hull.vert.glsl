#define PAGE 2.0
#define SPINS 1.0
#include "hull.vert.glsl"
