// Level 5 of the pyramid: 1/32 of the canvas. Channel 0 is the level before, channel 1 Buffer A, for its size. The last
// level: without its alpha.

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = plain(down(iChannel0, fragCoord, 5, iChannelResolution[1].xy, iResolution.xy));
}
