// Grid 1, going up: swept again.
#include "post.glsl"
