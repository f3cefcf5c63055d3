#define PAGE 1.0
#define SPINS 0.6
#include "mesh.vert.glsl"
