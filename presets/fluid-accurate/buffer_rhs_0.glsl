// The divergence of the advected velocity: what flows out of each cell. Channel 0 is the advected velocity.
#define VELOCITY iChannel0
#include "staggered.glsl"

void mainImage(out vec4 f, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    f = vec4(across(p + ivec2(1, 0)) - across(p) + upwards(p + ivec2(0, 1)) - upwards(p), 0.0, 0.0, 0.0);
}
