// The coarsest grid, a handful of cells: two sweeps, drawn 20 times a frame, from where the last frame ended.
// Channel 0 is f, channel 1 this buffer, channel 2 any texture of the finest grid. Its mean means nothing, and the
// 0.9999 keeps it from wandering off.
#include "multigrid.glsl"
#define INSIDE(p) vec2(0.9999 * orZero(texelFetch(iChannel1, p, 0).x), texelFetch(iChannel0, p, 0).x)
#define FINEST iChannel2
#include "sweeps.glsl"
