// Grid 4, going up: swept again.
#include "post.glsl"
