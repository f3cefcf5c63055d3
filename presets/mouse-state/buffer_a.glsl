// Strokes, with the memory in texel (0, 0). Channel 0 is this buffer in the last frame.

void mainImage(out vec4 ink, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec3 now = hand(iMouse, iTime, iResolution.xy);
    vec4 before = texelFetch(iChannel0, MEMORY, 0); // iFrame == 0: all zeros, which is no signature
    if (p.y == MEMORY.y) {
        ink = p == MEMORY ? remember(now, iResolution.xy) : vec4(0.0);
        return;
    }
    ink = draw(texelFetch(iChannel0, p, 0), fragCoord, before, now, iResolution.xy, iTimeDelta);
}
