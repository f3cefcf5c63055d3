#include "b.glsl"
float a() { return 2.0 * b(); }
