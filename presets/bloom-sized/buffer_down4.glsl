// Level 4 of the pyramid: 1/16 of the canvas. Channel 0 is the level before, channel 1 Buffer A, for its size.

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = down(iChannel0, fragCoord, 4, iChannelResolution[1].xy, iResolution.xy);
}
