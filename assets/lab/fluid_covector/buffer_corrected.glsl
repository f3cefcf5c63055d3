#include "pull_back.glsl"

// And back: half of what there and back has changed is put right (BFECC: Kim, Liu, Llamas and Rossignac 2005).
void mainImage(out vec4 corrected, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 before = at(iChannel1, p), back = pullBack(iChannel2, iChannel0, p, false);
    corrected = vec4(before + 0.5 * (before - back), 0.0, 1.0);
}
