// The same strokes, with the memory at MEMORY_UV. Channel 0 is this buffer in the last frame; its filter is "nearest".

void mainImage(out vec4 ink, in vec2 fragCoord) {
    vec3 now = hand(iMouse, iTime, iResolution.xy);
    vec4 before = textureLod(iChannel0, MEMORY_UV, 0.0);
    if (ivec2(fragCoord) == ivec2(MEMORY_UV * iResolution.xy)) {
        ink = remember(now, iResolution.xy);
        return;
    }
    ink = draw(texelFetch(iChannel0, ivec2(fragCoord), 0), fragCoord, before, now, iResolution.xy, iTimeDelta);
}
