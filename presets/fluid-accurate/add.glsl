// Going up: the finer grid's q, and what the coarser one found for it. Channel 0 is the finer grid's (q, f), channel 1
// the coarser grid's q. Gives (q, f).
#include "multigrid.glsl"

void mainImage(out vec4 result, in vec2 fragCoord) {
    vec2 coarse = vec2(textureSize(iChannel1, 0));
    vec2 at = fragCoord * coarse / iResolution.xy - 0.5;
    ivec2 i = ivec2(floor(at)), size = ivec2(coarse);
    vec2 t = at - vec2(i);
    ivec2 a = cellAt(i, size), b = cellAt(i + 1, size);
    float found = mix(mix(texelFetch(iChannel1, a, 0).x, texelFetch(iChannel1, ivec2(b.x, a.y), 0).x, t.x),
                      mix(texelFetch(iChannel1, ivec2(a.x, b.y), 0).x, texelFetch(iChannel1, b, 0).x, t.x), t.y);
    vec2 here = texelFetch(iChannel0, ivec2(fragCoord), 0).xy;
    result = vec4(orZero(here.x + found), here.y, 0.0, 0.0);
}
