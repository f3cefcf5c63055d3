// Grid 3, going up: swept again.
#include "post.glsl"
