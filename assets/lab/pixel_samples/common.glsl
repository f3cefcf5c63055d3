#ifndef METHOD
#define METHOD GRID
#endif
// Samples along each side of a pixel.
#ifndef SIDE
#define SIDE 4
#endif
// Pixels of the canvas for one of the scene.
#ifndef ZOOM
#define ZOOM 1.0
#endif
#define GRID 0
#define HALTON 1
#define JITTER 2

#include "scene.glsl"
#include "radical_inverse.glsl"
#include "pcg.glsl"
