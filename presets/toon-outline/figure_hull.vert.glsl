#define PAGE 0.0
#define SPINS 0.0
#include "hull.vert.glsl"
