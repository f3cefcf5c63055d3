// 1/2 of the canvas. Channel 0 is the history.

#include "pyramid.glsl"

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = down(iChannel0, fragCoord, 1, iChannelResolution[0].xy, iResolution.xy);
}
