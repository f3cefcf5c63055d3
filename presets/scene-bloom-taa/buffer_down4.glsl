// 1/16 of the canvas. Channel 0 is the level before, channel 1 the history, for its size. The last level: without its
// alpha.

#include "pyramid.glsl"

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = plain(down(iChannel0, fragCoord, 4, iChannelResolution[1].xy, iResolution.xy));
}
