#include "lib/a.glsl"
