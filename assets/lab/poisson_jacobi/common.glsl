#include "solved.glsl"
