// Grid 0, going up: swept again.
#include "post.glsl"
