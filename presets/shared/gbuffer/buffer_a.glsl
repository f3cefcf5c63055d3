// The G-buffer (gbuffer.glsl says what is in it).

#include "scene.glsl"

void mainImage(out vec4 texel, in vec2 fragCoord) {
    texel = surface(fragCoord, iResolution.xy, iMouse, iTime);
}
