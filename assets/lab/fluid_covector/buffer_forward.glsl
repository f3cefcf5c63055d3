#include "pull_back.glsl"

// There.
void mainImage(out vec4 carried, in vec2 fragCoord) {
    carried = vec4(pullBack(iChannel1, iChannel0, ivec2(fragCoord), true), 0.0, 1.0);
}
