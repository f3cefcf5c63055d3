#define PAGE 1.0
#define SPINS 0.6
#include "hull.vert.glsl"
