// Carries a field along its paths: channels 0 and 1 are the curves of the velocity's components, 2 and 3 those of the
// field. The text that includes this says for how long: STEPS 1.0 forward, -1.0 back in time.
#include "staggered.glsl"

#ifdef TRUST
const float TRUST_LOW = 1.0, TRUST_HIGH = 2.0;

// There and back ends where it began only where paths do not cross, which is up to a deformation of 1 in a step.
// Beyond, what the way back says is noise, and correcting by it feeds that noise.
float trust(ivec2 p, float cells) {
    ivec2 last = textureSize(iChannel0, 0) - 1;
    ivec2 l = max(p - ivec2(1, 0), ivec2(0)), r = min(p + ivec2(1, 0), last);
    ivec2 d = max(p - ivec2(0, 1), ivec2(0)), u = min(p + ivec2(0, 1), last);
    float stretched = max(abs(texelFetch(iChannel0, r, 0).x - texelFetch(iChannel0, p, 0).x),
                          abs(texelFetch(iChannel1, u, 0).x - texelFetch(iChannel1, p, 0).x));
    float sheared = 0.5 * max(abs(texelFetch(iChannel0, u, 0).x - texelFetch(iChannel0, d, 0).x),
                              abs(texelFetch(iChannel1, r, 0).x - texelFetch(iChannel1, l, 0).x));
    return 1.0 - smoothstep(TRUST_LOW, TRUST_HIGH, abs(cells) * max(stretched, sheared));
}
#endif

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
#ifdef TRUST
    carried.z = trust(p, cells);
#endif
}
