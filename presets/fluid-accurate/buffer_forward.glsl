// The first step of MacCormack: every face's velocity is what was upstream. Channel 0 is the velocity of the last frame.
#define VELOCITY iChannel0
#include "staggered.glsl"

void mainImage(out vec4 forward, in vec2 fragCoord) {
    vec2 corner = floor(fragCoord);
    float cells = speed * iTimeDelta * float(grid().y);
    forward = vec4(acrossAt(path(corner + vec2(0.0, 0.5), cells)), upwardsAt(path(corner + vec2(0.5, 0.0), cells)), 0.0, 0.0);
}
