// The divergence that is still to go: what flows out of each cell. Channel 0 is the velocity that the pressure has
// pushed.
#include "staggered.glsl"

void mainImage(out vec4 f, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float out_x = faceOf(iChannel0, p + ivec2(1, 0), 0) - faceOf(iChannel0, p, 0);
    float out_y = faceOf(iChannel0, p + ivec2(0, 1), 1) - faceOf(iChannel0, p, 1);
    f = vec4(out_x + out_y, 0.0, 0.0, 0.0);
}
