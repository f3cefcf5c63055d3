// 1/4 of the canvas. Channel 0 is the level before, channel 1 the history, for its size.

#include "pyramid.glsl"

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = down(iChannel0, fragCoord, 2, iChannelResolution[1].xy, iResolution.xy);
}
