// Left of the line the samples of this frame, right of it what TAA makes of them, and a lens over both. Drag to move
// them. Channel 0 is Buffer A, channel 1 Buffer B.

#iUniform float split = 0.42 in { 0.0, 1.0 } // where the line is, while the mouse has not moved it
#iUniform float zoom = 5.0 in { 1.0, 12.0 }

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 mouse = iMouse.z > 0.0 || abs(iMouse.x) + abs(iMouse.y) > 0.0 ? iMouse.xy + 0.5
        : vec2(split, 0.58) * iResolution.xy;
    float radius = 0.17 * unit(iResolution.xy);
    vec2 toLens = fragCoord - mouse;
    bool lens = split > 0.0 && split < 1.0 && zoom > 1.0 && length(toLens) < radius;
    vec2 from = lens ? mouse + toLens / zoom : fragCoord;
    ivec2 p = clamp(ivec2(floor(from)), ivec2(0), ivec2(iResolution.xy) - 1);
    bool right = fragCoord.x >= (split <= 0.0 || split >= 1.0 ? split * iResolution.x : mouse.x);
    vec3 colour = right ? texelFetch(iChannel1, p, 0).rgb : texelFetch(iChannel0, p, 0).rgb;
    if (split > 0.0 && split < 1.0) {
        float line = min(abs(toLens.x), max(abs(length(toLens) - radius), 0.0));
        if (zoom <= 1.0) line = abs(toLens.x);
        colour = mix(colour, vec3(0.98, 0.97, 0.94), clamp(1.4 - line, 0.0, 1.0));
    }
    fragColor = vec4(colour, 1.0);
}
