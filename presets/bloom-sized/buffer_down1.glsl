// Level 1 of the pyramid: 1/2 of the canvas. Channel 0 is Buffer A, the picture.

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = down(iChannel0, fragCoord, 1, iChannelResolution[0].xy, iResolution.xy);
}
