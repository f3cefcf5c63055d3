// Back up to 1/2 of the canvas. Channel 0 is this level on the way down, channel 1 all that is wider, channel 2 Buffer
// A, for its size.

void mainImage(out vec4 light, in vec2 fragCoord) {
    vec4 wider = tent(iChannel1, fragCoord, 2, iChannelResolution[2].xy);
    light = mix(plain(texelFetch(iChannel0, ivec2(fragCoord), 0)), wider, spread);
}
