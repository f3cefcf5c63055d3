// Going up: two more sweeps. Channel 0 is this grid's (q, f), channel 1 any texture of the finest grid.
#include "multigrid.glsl"
#define INSIDE(p) texelFetch(iChannel0, p, 0).xy
#define FINEST iChannel1
#include "sweeps.glsl"
