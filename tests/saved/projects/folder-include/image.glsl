#include "lib/noise.glsl"
void mainImage(out vec4 o, in vec2 p) { o = vec4(vec3(float(pcg(uint(p.x) + 64u * uint(p.y))) / 4294967295.0), 1.0); }
