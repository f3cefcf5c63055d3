// Grid 2, going up: swept again.
#include "post.glsl"
