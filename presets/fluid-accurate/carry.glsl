// Carries a field along its paths: channels 0 and 1 are the curves of the velocity's components, 2 and 3 those of the field.
// The text that includes this says for how long: STEPS 1.0 forward, -1.0 back in time.
#include "staggered.glsl"

void mainImage(out vec4 carried, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float cells = STEPS * speed * iTimeDelta * iChannelResolution[0].y;
    vec2 left = faceAt(p, 0), bottom = faceAt(p, 1);
    vec2 atLeft = vec2(texelFetch(iChannel0, p, 0).x, cubicAt(iChannel1, left, 1));
    vec2 atBottom = vec2(cubicAt(iChannel0, bottom, 0), texelFetch(iChannel1, p, 0).x);
    vec2 moved = vec2(cubicAt(iChannel2, path(iChannel0, iChannel1, left, atLeft, cells), 0),
                      cubicAt(iChannel3, path(iChannel0, iChannel1, bottom, atBottom, cells), 1));
    if (walls != PERIODIC) moved *= vec2(greaterThan(p, ivec2(0)));
    carried = vec4(moved, 0.0, 0.0);
}
