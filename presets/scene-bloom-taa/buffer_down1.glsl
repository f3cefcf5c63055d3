// 1/2 of the canvas. Channel 0 is the history.

#include "pyramid.glsl"

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = down13(iChannel0, 2.0 * fragCoord, iChannelResolution[0].xy);
}
