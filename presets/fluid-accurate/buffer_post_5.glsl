// Grid 5, going up: swept again.
#include "post.glsl"
